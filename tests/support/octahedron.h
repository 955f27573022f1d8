// SPDX-License-Identifier: MIT
// An octahedron of four tets around one diagonal, with the coordinates that a test wants.
#pragma once

#include <set>

#include "kernel/mesh_data.h"
#include "tests/support/tets.h"

namespace tetmend::test {

//            1               The edge 0-1 is inside; its ring is 2 3 4 5. The other two diagonals
//         / /  \ \           are 2-4 and 3-5: lengths 2 h, 2 x and 2 y. `lift` moves the ring up
//       2--3----4            along the edge.
//        \  \ 5/
//           0
inline MeshData octahedron(double h, double x, double y, double lift = 0) {
  MeshData data;
  data.points = {{0, 0, -h}, {0, 0, h}, {x, 0, lift}, {0, y, lift}, {-x, 0, lift}, {0, -y, lift}};
  data.tets = {{{0, 1, 2, 3}, 7}, {{0, 1, 3, 4}, 7}, {{0, 1, 4, 5}, 7}, {{0, 1, 5, 2}, 7}};
  return data;
}

/// Its tets around the diagonal from which it is made, and those around the other two.
inline const std::set<Corners> kAround01 = {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 2, 5}};
inline const std::set<Corners> kAround24 = {{0, 2, 3, 4}, {0, 2, 4, 5}, {1, 2, 3, 4}, {1, 2, 4, 5}};
inline const std::set<Corners> kAround35 = {{0, 2, 3, 5}, {0, 3, 4, 5}, {1, 2, 3, 5}, {1, 3, 4, 5}};
/// What it becomes when all of them give way to a vertex 6.
inline const std::set<Corners> kAround6 = {{0, 2, 3, 6}, {0, 3, 4, 6}, {0, 4, 5, 6}, {0, 2, 5, 6},
                                           {1, 2, 3, 6}, {1, 3, 4, 6}, {1, 4, 5, 6}, {1, 2, 5, 6}};

}  // namespace tetmend::test
