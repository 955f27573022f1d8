// SPDX-License-Identifier: MIT
// How the edges of a mesh keep to its wanted lengths, also of one that is never there as a whole.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "kernel/tet_mesh.h"
#include "kernel/wanted_lengths.h"

namespace tetmend::face {

/// What adds up over the shares of a mesh. See SizeStatistics for the meaning.
struct SizeCounts {
  std::uint64_t edges = 0;
  std::array<std::uint64_t, SizeStatistics::kBounds.size() + 1> histogram{};
  std::uint64_t in_range = 0;
  std::uint64_t within_two = 0;
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  std::uint64_t on_surface = 0;
  std::uint64_t between_walls = 0;
  double tets_wanted = 0;

  void add(const SizeCounts& other);
  SizeStatistics statistics() const;
};

/// Which edges, tets and vertices of a mesh are of a share; without functions all are. All tets at an edge
/// or a vertex of the share must be there.
struct SizeScope {
  std::function<bool(VertexHandle, VertexHandle)> has_edge = {};
  std::function<bool(TetHandle)> has_tet = {};
  std::function<bool(VertexHandle)> has_vertex = {};
};

/// `between_walls` counts edges whose ends are both of the share. Cost: n log n.
SizeCounts count_sizes(const TetMesh& mesh, const WantedLengths& wanted,
                       const SizeScope& scope = {});
/// Precondition: the mesh has wanted lengths.
SizeStatistics size_statistics(const TetMesh& mesh);

/// What there is to say about the lengths, before anything is done.
/// @throws OptionError where they ask for more tets than any mesh has, and Options::tets is no bound
std::vector<std::string> remarks_on(const SizeStatistics& before, const Options& options);

}  // namespace tetmend::face
