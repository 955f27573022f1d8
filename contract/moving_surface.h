// SPDX-License-Identifier: MIT
// What must stay of a surface that may change: it lies near the one that there was, and where that
// was near nothing else, there is something still.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernel/tet_mesh.h"

namespace tetmend::contract {

/// The faces of a surface by the labels of their two sides, as points alone.
struct SurfaceShape {
  using Triangle = std::array<Point, 3>;
  /// The smaller label first, and whether the other side is outside.
  using Sides = std::pair<Label, std::pair<bool, Label>>;

  std::map<Sides, std::vector<Triangle>> faces;
  double diagonal = 0;  ///< of the box around them
  /// How far the surface may move from here, as the guard was asked: a share of the mean edge
  /// length of each triangle, or a length; both 0: by rounding alone.
  double share = 0, length = 0;

  bool is_flat() const { return share == 0 && length == 0; }
  /// Of a triangle of this surface. Computed from what was asked: a guard that grants more is
  /// found out.
  double tolerance(const Triangle& t) const;
};

/// Precondition: the mesh has a guard.
SurfaceShape surface_shape(const TetMesh& mesh);

/// What is wrong with a surface that was another before; empty if nothing is. Samples where faces
/// are others than before, in both directions, each triangle of the old surface with a tolerance
/// of its own; asks for the same areas if that is 0. Shares no code with the guard.
/// Cost: the product of the numbers of faces, of which most are passed over.
std::string complaint_about_shape(const SurfaceShape& before, const SurfaceShape& now);

}  // namespace tetmend::contract
