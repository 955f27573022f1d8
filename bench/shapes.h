// SPDX-License-Identifier: MIT
// Shapes of tets and angles at inner faces from plain arrays, by formulas of their own.
#pragma once

#include <cstddef>

#include "kernel/mesh_data.h"

namespace tetmend::bench {

/// Of a mesh. The ratios are 1 for the regular tet and 0 for a flat or an inverted one, but for the
/// edge ratio, which grows from 1.
struct Shapes {
  double worst_mean_ratio = 0;
  double mean_mean_ratio = 0;
  double worst_radius_ratio = 0;
  double mean_radius_ratio = 0;
  double worst_edge_ratio = 0;
  double mean_edge_ratio = 0;
  std::size_t inner_faces = 0;
  std::size_t faces_above_70 = 0;  // degrees of non-orthogonality
};

/// @param orientation  1, or -1 if the file lists the vertices of a tet the other way round
Shapes shapes(const MeshData& mesh, double orientation);

}  // namespace tetmend::bench
