// SPDX-License-Identifier: MIT
// What a file holds besides its mesh, while that is changed: mid-side nodes, parts, groups, arrays.
#pragma once

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"

namespace tetmend::viewer {

/// The data have something that a TetMesh does not know.
bool holds_more_than_mesh(const MeshData& data);

/// `mesh` as data, with all that `before` holds besides, as a run carries it over.
/// Precondition: `mesh` was built of `before` in its order, and changed; the surface is the same.
/// Cost: n log n.
MeshData carried_data(const MeshData& before, const TetMesh& mesh);

}  // namespace tetmend::viewer
