// SPDX-License-Identifier: MIT
// What tets have in common with elements that are none: prisms, pyramids, hexahedra, shells.
//
// Those elements stay as they are. So must each face and edge of a tet that lies on one of them, or the
// mesh would tear there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

/// Faces and edges of tets all of whose vertices one other element has, and vertices of tets that one
/// has. Each once, its vertices ascending, in order.
struct SharedParts {
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::uint32_t> points;

  bool is_empty() const { return points.empty(); }
  std::size_t size() const { return faces.size() + edges.size() + points.size(); }
};

/// Of all other elements. Points, and clouds of them, share no more than themselves. Cost: nothing
/// without such elements; else linear, but for sorting what is found.
SharedParts find_shared_parts(const MeshData& mesh);

/// Those of them that lie within a region: nothing else keeps them. Cost: sorting the faces of the tets
/// that touch other elements.
SharedParts find_shared_inside(const MeshData& mesh, const SharedParts& shared);

/// Makes constraints of what is shared within regions. Precondition: the mesh has arrays for nothing
/// but labels, or what is added is taken off again.
void hold_shared_inside(MeshData& mesh);

/// How much of what `before` shares is not there any more, and how many points of its other elements lie
/// elsewhere. `now` has the same other elements.
/// @param vertex_map of the points before: their numbers now
std::size_t count_lost_parts(const MeshData& before, std::span<const std::uint32_t> vertex_map,
                             const MeshData& now);

}  // namespace tetmend
