// SPDX-License-Identifier: MIT
// Puts other contents into some slots of a mesh: for those who show what somebody else did to it.
#pragma once

#include <vector>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// What slots hold from now on. What is not listed stays as it is.
struct SlotContents {
  struct Vertex {
    VertexHandle vertex;
    bool is_there = false;
    Point point = Point::Zero();
  };
  struct Tet {
    TetHandle tet;
    TetVertices vertices;  ///< an invalid first one: no tet
    Label label = 0;
  };
  std::vector<Vertex> vertices;
  std::vector<Tet> tets;
};

/// Makes the mesh the one that a build of the whole would give: adjacency, qualities, constraints.
/// Unlike a Transaction it judges nothing and cannot be undone. `contents` lists a slot once, and
/// all tets at vertices that move. The tets listed fill the place of those that were in their slots;
/// boundary and constrained faces and edges stay. Vertices that come were not on the boundary.
/// False if the contents do not fit together: the mesh is of no use then.
/// Cost: that of the tets listed; a pass over all tets where a vertex is left without one.
TETMEND_API bool patch(TetMesh& mesh, const SlotContents& contents);

/// From now on writers list the vertices in the order of their slots. Cost: linear.
TETMEND_API void number_by_slots(TetMesh& mesh);

}  // namespace tetmend
