// SPDX-License-Identifier: MIT
// Shells and sandwiches in a mesh without adjacency, as replay has it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "trace/slot_mesh.h"

namespace tetmend::explain {

/// Vertices in a circle or, when `closed` is false, in a row. Tet i of a shell is (a, b, ring[i],
/// ring[i + 1]) with positive volume.
struct SlotShell {
  VertexHandle a, b;
  std::vector<VertexHandle> ring;
  std::vector<TetHandle> tets;
  bool closed = false;
};

/// Tets that contain all of these vertices, by slot. Cost: one pass over the tets, about 2 ms for a
/// million.
std::vector<TetHandle> tets_around(const SlotMesh& mesh, std::span<const VertexHandle> vertices);

/// The shell of an edge; empty if there is none. A closed ring begins at the vertex of least
/// number. Of several fans around an edge of the boundary, the first is taken. Cost: as above.
SlotShell find_slot_shell(const SlotMesh& mesh, VertexHandle a, VertexHandle b);

/// The same from the tets that contain both.
SlotShell shell_of(const SlotMesh& mesh, std::span<const TetHandle> tets, VertexHandle a,
                   VertexHandle b);

/// The same from a list of tets, some of which may not contain the edge. `tets` are numbers in it.
struct NamedTet {
  TetHandle tet;
  TetVertices vertices;
};
SlotShell order_shell(std::span<const NamedTet> tets, VertexHandle a, VertexHandle b);

/// The circle around triangles that form a disc, in their orientation; empty if they do not.
std::vector<VertexHandle> circle_around(std::span<const std::array<VertexHandle, 3>> triangles);

/// The other two vertices of a tet, p and q, so that (a, b, p, q) has its orientation.
/// Precondition: the tet contains a and b.
std::array<VertexHandle, 2> others(const TetVertices& tet, VertexHandle a, VertexHandle b);
/// The other three, p, q and r, so that (a, p, q, r) has its orientation.
std::array<VertexHandle, 3> others(const TetVertices& tet, VertexHandle a);

inline bool contains(const TetVertices& tet, VertexHandle v) {
  return tet[0] == v || tet[1] == v || tet[2] == v || tet[3] == v;
}

}  // namespace tetmend::explain
