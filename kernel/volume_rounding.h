// SPDX-License-Identifier: MIT
// How far the volume of one and the same mesh may seem to change.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "kernel/mesh_data.h"

namespace tetmend {

/// The longest side of the box around points; 0 for none.
inline double longest_side(std::span<const Point> points) {
  if (points.empty()) return 0;
  Point low = points[0];
  Point high = points[0];
  for (const Point& p : points) {
    low = low.cwiseMin(p).eval();
    high = high.cwiseMax(p).eval();
  }
  return (high - low).maxCoeff();
}

/// Whether a relative change of a volume is one of rounding alone, which other tets in the same surface
/// bring: at most 1e-9, but more of a thin mesh. There the volume of a tet is a small difference of
/// products that may be as large as the cube of the longest side.
/// @param volume, side  in the same lengths; side: called where that decides
template <class Side>
bool is_rounding(double change, double volume, const Side& side) {
  constexpr double kOrdinary = 1e-9;
  constexpr double kProducts = 64 * std::numeric_limits<double>::epsilon();
  if (change <= kOrdinary) return true;
  const double length = side();
  return change * std::abs(volume) <= kProducts * length * length * length;
}

}  // namespace tetmend
