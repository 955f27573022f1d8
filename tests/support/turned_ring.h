// SPDX-License-Identifier: MIT
// A mesh whose tets cannot all be listed in one sense.
#pragma once

#include "kernel/mesh_data.h"

namespace tetmend::test {

/// Eight tets in a ring, each joined to the next by a face, the last to the first turned round, as
/// in a Moebius strip. Tet 5, from 0, is found to lie on the same side of a face as tet 4.
inline MeshData turned_ring() {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                 {1, 1, 1}, {2, 0, 1}, {0, 2, 1}, {1, 1, 3}};
  mesh.tets = {{{0, 1, 2, 3}, 0}, {{1, 2, 3, 4}, 0}, {{2, 3, 4, 5}, 0}, {{3, 4, 5, 6}, 0},
               {{4, 5, 6, 7}, 0}, {{5, 6, 7, 1}, 0}, {{6, 7, 1, 0}, 0}, {{7, 1, 0, 2}, 0}};
  return mesh;
}

}  // namespace tetmend::test
