// SPDX-License-Identifier: MIT
// The least mesh that needs recursion.
#pragma once

#include "kernel/mesh_data.h"

namespace tetmend::test {

// Two overlapping shells ([chen, Fig. 5]). Edge 0 1 can be removed only after its face (0, 1, 4)
// is. That face vanishes with the link edge 0 4, whose shell has a tet of its own, (5, 0, 4, 2).
inline MeshData two_shells() {
  MeshData data;
  data.points = {{-0.52, -0.44, 0.73}, {0.52, 0.44, -0.73}, {-0.41, 1.14, 1.12},
                 {0.95, 0.51, 0.87},   {0.08, 1.55, -0.12}, {-1.02, -0.02, -0.21},
                 {-0.15, -0.65, -0.19}};
  data.tets = {{{0, 2, 3, 1}}, {{0, 4, 2, 1}}, {{5, 4, 0, 1}},
               {{5, 0, 4, 2}}, {{5, 0, 6, 1}}, {{0, 3, 6, 1}}};
  return data;
}

}  // namespace tetmend::test
