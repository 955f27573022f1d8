// SPDX-License-Identifier: MIT
// Keeps apart what a file tells apart on a surface that may change: while the mesh is worked on,
// triangles and edges have a mark for their label.
#pragma once

#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::face {

/// Elements with the same label and part, in the same groups, have the same mark, from 1 on.
struct SurfaceMarks {
  std::vector<Label> triangles, edges;  ///< by number in the file; empty: labels are enough
  bool empty() const { return triangles.empty() && edges.empty(); }
};

/// Empty where labels say as much. Cost: n log n in the triangles and edges.
SurfaceMarks mark_surface(const MeshData& data);

/// Gives the triangles and edges of the file their marks for labels; others, behind them, get 0.
void put_marks(const SurfaceMarks& marks, MeshData& data);

}  // namespace tetmend::face
