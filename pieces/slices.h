// SPDX-License-Identifier: MIT
// Between the arrays of a whole mesh and its pieces.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"
#include "pieces/divided_mesh.h"
#include "pieces/piece.h"

namespace tetmend::pieces {

/// Slices of about so many tets. How many there are cannot show in the result.
inline constexpr std::size_t kTetsOfSlice = 500'000;
/// The same, of a mesh that is for so many pieces.
inline std::size_t tets_of_slice(std::uint64_t tets, std::size_t pieces) {
  return std::min<std::size_t>(kTetsOfSlice, 1 + tets / pieces);
}

/// Adds a mesh, on one rank, to one that has nothing yet; end_slices() is left to the caller.
/// `is_protected` has a mark for each tet, or none; `is_kept` one for each point, where the surface may
/// move: that of find_kept_points().
void add_slices(const MeshData& data, std::span<const char> is_protected, DividedMesh& to,
                std::span<const char> is_kept = {});

/// All of a mesh again, and where its parts come from.
struct Joined {
  MeshData data;  ///< vertices of the file in their order, then the others; tets by piece
  std::vector<std::uint32_t> vertex_origins;  ///< by vertex: number in the file, or kGone
  std::vector<std::uint32_t> tet_origins;     ///< by tet, likewise, or PieceTet::kNone
  std::vector<char> is_protected;             ///< by tet
};

/// Where the vertices and tets of the file are in `joined`, or kGone.
struct Maps {
  std::vector<std::uint32_t> vertices, tets;
};
Maps maps_of(const Joined& joined, std::size_t vertices, std::size_t tets);

/// Puts the stored pieces together. `vertices`: of the file.
Joined join(const DividedMesh& mesh, std::size_t vertices);

}  // namespace tetmend::pieces
