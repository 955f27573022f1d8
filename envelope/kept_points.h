// SPDX-License-Identifier: MIT
// Points of a file that stay where they are, whatever else of the surface may move.
#pragma once

#include <span>
#include <vector>

#include <tetmend/api.h>

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// What find_kept_points() says of a point.
inline constexpr char kKeptPoint = 1;  ///< it stays
inline constexpr char kHeldPoint = 2;  ///< so does what lies between it and others of these

/// By point of `input`: kHeldPoint for those of periodic links, of elements that are no tets, triangles
/// or edges, and of the groups RequiredEdges and RequiredTriangles, as MEDIT calls them; kKeptPoint for
/// those of its group Corners; 0 for all others. What `required_vertices` names, a TetMesh knows itself.
/// Cost: linear.
TETMEND_API std::vector<char> find_kept_points(const MeshData& input);

/// The vertices of a mesh that was built of that data, for FeatureOptions::kept.
TETMEND_API std::vector<VertexHandle> kept_vertices(const TetMesh& mesh,
                                                    std::span<const char> kept_points);
/// Those of held points, for FeatureOptions::held.
TETMEND_API std::vector<VertexHandle> held_vertices(const TetMesh& mesh,
                                                    std::span<const char> kept_points);

}  // namespace tetmend
