// SPDX-License-Identifier: MIT
// What must stay though no label says so, in terms that TetMesh understands.
#pragma once

#include "kernel/mesh_data.h"

namespace tetmend::face {

/// Names as triangles and edges, behind those of the data: faces between two parts of one label,
/// edges within a region whose mid-side node cannot move, and what tets share with other elements
/// there. The arrays for elements fit no longer then; carry() drops what was added.
/// @param interior triangles and edges within a region are constraints
void name_constraints(MeshData& data, bool interior);

}  // namespace tetmend::face
