// SPDX-License-Identifier: MIT
// Walls, the faces that every operation keeps, and the sectors between them.
//
//     walls around an edge, seen along it     Every mesh with the same walls has exactly one tet
//            \  sector  /                     on each side of a wall, unless that is outside. It
//             \        /                      fills each sector with tets at the edge, whose angles
//              \______/____ wall              add up to that of the sector.
//              / edge
#pragma once

#include "kernel/tet_mesh.h"

namespace tetmend {

/// A triangle of the boundary, a constrained face, or a face at which frozen tets end.
inline bool is_wall(const TetMesh& mesh, HalfFace f) {
  const HalfFace twin = mesh.twin(f);
  return twin.is_outside() || mesh.is_constrained(f) ||
         mesh.is_frozen(f.tet()) != mesh.is_frozen(twin.tet());
}

/// The space between a wall and the next one around one of its edges, on the side of its tet.
struct Sector {
  HalfFace other;     ///< the next wall; its tet lies in the sector
  VertexHandle apex;  ///< its third vertex
  double angle = 0;   ///< radians; up to 2 pi, which the two sides of a free-standing face have
};

/// The sector at the edge opposite corner i of vertices(wall). The angle depends on the two walls
/// alone, whatever the tets between them are. Precondition: is_wall(mesh, wall). Cost: one step for
/// each tet of the sector.
Sector find_sector(const TetMesh& mesh, HalfFace wall, unsigned i);

/// The tet of the lowest quality in that sector. Precondition and cost: the same.
TetHandle worst_in_sector(const TetMesh& mesh, HalfFace wall, unsigned i);

}  // namespace tetmend
