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
};

SurfaceShape surface_shape(const TetMesh& mesh);

/// By how much a surface may be off that of the mesh when its guard was made; 0: only by rounding.
/// Precondition: it has a guard.
double surface_tolerance(const TetMesh& mesh);

/// What is wrong with a surface that was another before; empty if nothing is. Samples where faces
/// are others than before, in both directions; asks for the same areas if the tolerance is 0.
/// Cost: the product of the numbers of faces, of which most are passed over.
std::string complaint_about_shape(const SurfaceShape& before, const SurfaceShape& now,
                                  double tolerance);

}  // namespace tetmend::contract
