// SPDX-License-Identifier: MIT
// Second order in, second order out.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::face {

/// Gives every edge of `now`, what TetMesh::to_data() made of `before` after a run, its mid-side
/// node: the old one, in its place if both ends are in theirs and else in the middle, or a new one in
/// the middle, behind all points. Nodes of edges that are gone go. `vertex_map` becomes that of the
/// points that are left. Cost: n log n.
void renew_mid_nodes(const MeshData& before, std::vector<std::uint32_t>& vertex_map, MeshData& now);

}  // namespace tetmend::face
