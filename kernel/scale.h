// SPDX-License-Identifier: MIT
// Meshes of any size: a power of two between the lengths of a file and those that are worked with.
#pragma once

#include <span>

#include "kernel/mesh_data.h"

namespace tetmend {

/// What lengths are multiplied by on the way from the mesh to the file. A quality multiplies up to
/// 16 lengths with each other, so lengths outside of about 1e-19 to 1e19 leave the doubles. A power
/// of two changes no digit. A value of a few words; immutable.
class Scale {
 public:
  /// Boxes of this width are worked with as they are: tets a million times smaller or larger leave
  /// room enough on both sides.
  static constexpr int kLeastOrdinary = -20;  ///< exponent of 2, about 1e-6
  static constexpr int kMostOrdinary = 40;    ///< about 1e12
  /// Of boxes that can be worked with at all: from 7e-161 to 1.4e160.
  static constexpr int kLargest = 532;
  /// A tet must be longer than that, in lengths that are worked with, about 1e-18.
  static constexpr double kShortestTet = 0x1p-60;

  /// 1.
  Scale() = default;
  /// @param exponent of 2, at most 1022 either way
  explicit Scale(int exponent);
  /// 1 for an ordinary box around the points; else the power that makes the box between a half and
  /// one wide.
  /// @throws Error where that would change digits, or the box is too small or too large.
  /// Cost: linear.
  static Scale of(std::span<const Point> points);

  int exponent() const { return exponent_; }
  bool is_one() const { return exponent_ == 0; }
  double to_file(double length) const { return length * to_file_; }
  Point to_file(const Point& p) const { return times(p, to_file_); }
  double to_work(double length) const { return length * to_work_; }
  Point to_work(const Point& p) const { return times(p, to_work_); }
  void to_file(std::vector<Point>& points) const;
  void to_work(std::vector<Point>& points) const;
  friend bool operator==(const Scale&, const Scale&) = default;

 private:
  /// One by one: what Eigen makes of a product takes a compiler a while, in each program.
  static Point times(const Point& p, double factor) {
    return {p.x() * factor, p.y() * factor, p.z() * factor};
  }
  int exponent_ = 0;
  double to_file_ = 1;
  double to_work_ = 1;
};

/// The tet is shorter than Scale::kShortestTet, but not flat: its quality would be that of a flat
/// one. Points as they are worked with.
bool is_lost(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace tetmend
