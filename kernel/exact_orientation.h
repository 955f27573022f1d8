// SPDX-License-Identifier: MIT
// Orientation of every tet by exact arithmetic: the final word on whether a mesh is valid.
#pragma once

#include <cstddef>

#include "kernel/tet_mesh.h"

namespace tetmend {

struct OrientationCounts {
  std::size_t positive = 0;
  std::size_t flat = 0;      ///< volume exactly zero
  std::size_t inverted = 0;  ///< negative volume
};

/// Counts the live tets by the exact sign of their volume (CGAL's filtered kernel). Cost: linear, exact arithmetic only where
/// rounding leaves the sign open.
OrientationCounts count_orientations(const TetMesh& mesh);

}  // namespace tetmend
