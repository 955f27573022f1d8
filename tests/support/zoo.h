// SPDX-License-Identifier: MIT
// The zoo as tests use it.
#pragma once

#include "contract/zoo.h"
#include "kernel/tet_mesh.h"

namespace tetmend::test {

using namespace contract;

inline TetMesh make_mesh(const MeshData& data) {
  return TetMesh(data);
}

/// Sum of the signed volumes of all live tets.
inline double total_volume(const TetMesh& mesh) {
  double sum = 0;
  for (const TetHandle t : live_tets(mesh)) {
    const TetVertices& v = mesh.vertices(t);
    sum += volume6(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])) / 6;
  }
  return sum;
}

}  // namespace tetmend::test
