// SPDX-License-Identifier: MIT
// Order of points along a Hilbert curve: neighbours on the curve are neighbours in space.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

/// A Hilbert curve of 2^21 cells a side through the bounding cube of some points.
class HilbertCurve {
 public:
  explicit HilbertCurve(std::span<const Point> points);

  static constexpr int kBits = 21;
  /// Numbers of a cell along x, y and z, from 0.
  using Cell = std::array<std::uint32_t, 3>;
  /// That which holds p, or of a point outside of the box the nearest. No number falls where a
  /// coordinate grows.
  Cell cell(const Point& p) const;
  /// Its position along the curve, 3 kBits bits. Cells whose numbers differ in their last k bits alone
  /// follow each other: their positions differ in the last 3 k bits.
  static std::uint64_t key(const Cell& cell);
  std::uint64_t key(const Point& p) const { return key(cell(p)); }

 private:
  Point origin_ = Point::Zero();
  double scale_ = 0;  // cells per unit length
};

/// Sorts numbers of points along the curve through all `points`; points of one cell by their
/// number.
void sort_along_curve(std::span<const Point> points, std::vector<std::uint32_t>& numbers);

}  // namespace tetmend
