// SPDX-License-Identifier: MIT
// Brings all that a file holds besides its mesh over to the improved mesh.
//
//   what has not changed keeps its values
//   point data: linear in the old tet that holds the new place of a point; integers come from the
//     vertex of that tet with the greatest weight
//   data and parts of tets: those of the old tet that holds the centroid
//   groups: a new point is in one that holds all vertices of its old tet
//   triangles, edges and other elements are the same: only the numbers of their vertices change
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetmend/improve.h>

#include "kernel/mesh_data.h"

namespace tetmend::face {

/// True if `data` holds more than TetMesh knows.
bool holds_more(const MeshData& data);

/// Triangles between tets of one label but two parts, to be named as constraints.
std::vector<MeshData::Triangle> walls_between_parts(const MeshData& data);

/// Gives `now`, what TetMesh::to_data() made of the improved mesh, all that `before` holds besides.
/// Triangles that `before` does not name go. The maps are those of maps.h.
/// @returns for each array, how, and what that did to its integral
std::vector<CarriedArray> carry(const MeshData& before, std::span<const std::uint32_t> vertex_map,
                                std::span<const std::uint32_t> tet_map, MeshData& now);

}  // namespace tetmend::face
