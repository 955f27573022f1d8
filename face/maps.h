// SPDX-License-Identifier: MIT
// Where the vertices and tets of a mesh went.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/tet_mesh.h"

namespace tetmend::face {

/// The number that TetMesh::to_data() gives to each vertex of the data that the mesh was built of;
/// kGone for those that are not there any more. `count` is their number then. Cost: linear.
std::vector<std::uint32_t> map_vertices(const TetMesh& mesh, std::size_t count);

/// The same for tets. `numbers` are those in the data, by slot, of BuildDetails::tet_numbers.
std::vector<std::uint32_t> map_tets(const TetMesh& mesh, std::span<const std::uint32_t> numbers);

}  // namespace tetmend::face
