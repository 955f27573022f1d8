// SPDX-License-Identifier: MIT
// The shell of an edge that lies on the surface: on the boundary, or on a face between two labels.
//
//    p_3 ------- p_2          Seen along the edge ab, which lies on the boundary: the ring is open,
//     |  .     .  |           from one outer face (a, b, p_0) to the other, (a, b, p_m). Between
//     |    . .    |           two labels the ring is closed, and two such faces divide it into two
//    p_4 -- ab -- p_1         sides.
//     outside  `p_0
#pragma once

#include <array>

#include <tetmend/api.h>

#include "kernel/shell.h"

namespace tetmend {

/// The tets of one label at an edge, from one face of the surface to the next.
struct TETMEND_API ShellSide {
  unsigned count = 0;  ///< of the tets; one less than that of the ring vertices
  std::array<VertexHandle, kMaxDegree + 1> ring;
  std::array<TetHandle, kMaxDegree> tets;  ///< tets[i] = (a, b, ring[i], ring[i+1])
};

struct TETMEND_API SurfaceShell {
  VertexHandle a;
  VertexHandle b;
  unsigned side_count = 0;  ///< 1: the edge lies on the boundary; 2: between two labels
  std::array<ShellSide, 2> sides;
};

/// `closed` for an edge on the surface with two faces of it, the shell of which lies in the
/// territory and has no frozen tet; the shell is then filled in. `constrained` for all other edges,
/// for instance inside a region or where more faces of the surface meet. An edge that the file
/// names is an edge like others. Precondition: the tet of the edge lies in the territory. Cost: one
/// step for each tet.
TETMEND_API ShellKind find_surface_shell(const TetMesh& mesh, TetEdge edge, SurfaceShell& shell,
                                         const Territory& territory);

}  // namespace tetmend
