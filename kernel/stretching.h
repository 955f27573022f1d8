// SPDX-License-Identifier: MIT
// Meshes that are stretched throughout, which may well be wanted: adapted to a flow, or a lattice.
#pragma once

#include <cstddef>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// The flat tets of a mesh: the least altitude is below a quarter of the longest edge.
struct Stretching {
  std::size_t tets = 0;  ///< that are not frozen
  std::size_t flat = 0;  ///< of them
  /// Mean cosine between the largest faces of two flat neighbours: 1 in a stack of parallel tets,
  /// about 0.7 among slivers and caps of no order.
  double alignment = 0;

  /// Most tets are flat, and alike.
  bool is_throughout() const;
};

/// Frozen tets are left out. Cost: linear, some 100 ns for each flat tet; call it only where many
/// tets are bad.
Stretching measure_stretching(const TetMesh& mesh);

}  // namespace tetmend
