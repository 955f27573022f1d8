// SPDX-License-Identifier: MIT
#include "face/constraints.h"

#include <vector>

#include "face/carry.h"
#include "kernel/curved.h"
#include "kernel/shared_parts.h"

namespace tetmend::face {

void name_constraints(MeshData& data, bool interior) {
  const std::vector<MeshData::Triangle> walls = walls_between_parts(data);
  data.triangles.insert(data.triangles.end(), walls.begin(), walls.end());
  const std::vector<MeshData::Edge> curved = find_fixed_mid_nodes(data, interior).inside;
  data.edges.insert(data.edges.end(), curved.begin(), curved.end());
  hold_shared_inside(data);
}

}  // namespace tetmend::face
