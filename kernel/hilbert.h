// SPDX-License-Identifier: MIT
// Order of points along a Hilbert curve: neighbours on the curve are neighbours in space.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

/// A Hilbert curve of 2^21 cells a side through the bounding cube of some points.
class HilbertCurve {
 public:
  explicit HilbertCurve(std::span<const Point> points);

  /// Position of the cell that holds p along the curve, 63 bits. Precondition: p lies in the
  /// bounding box of the points.
  std::uint64_t key(const Point& p) const;

 private:
  Point origin_ = Point::Zero();
  double scale_ = 0;  // cells per unit length
};

/// Sorts numbers of points along the curve through all `points`; points of one cell by their
/// number.
void sort_along_curve(std::span<const Point> points, std::vector<std::uint32_t>& numbers);

}  // namespace tetmend
