// SPDX-License-Identifier: MIT
// Where to put a vertex so that the worst tet of its ball is as good as possible. A pure unit:
// points in, point out.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kernel/quality.h"

namespace tetmend {

/// Maximises the smallest minimum sine over a ball, given by the triangles of its link. A steepest
/// ascent for a non-smooth function: the direction is the shortest vector in the convex hull of the
/// gradients of the sines that are nearly as small as the smallest
/// ([freitag_ollivier_gooch]).
class BallOptimiser {
 public:
  struct Limits {
    int steps = 40;            ///< directions tried
    double enough = 0.6;       ///< stop when the worst quality exceeds this
    double least_gain = 1e-5;  ///< stop when a step gains less
  };

  void clear();
  /// A link triangle; (p, a, b, c) is positive for a vertex p inside the ball.
  void add(const Point& a, const Point& b, const Point& c);
  std::size_t size() const { return size_; }

  /// Smallest minimum sine of the ball with its vertex at p. Keeps the values of the single tets,
  /// see qualities(). Cost: linear.
  double worst(const Point& p);
  /// Minimum sines of the tets at the last call of worst(), in the order of add().
  const double* qualities() const { return quality_.data(); }
  /// Sum of deficit() over the tets at the last call of worst().
  double total_deficit() const;

  /// Ascends from p; returns the best quality and moves p there. At least worst(p) of the start.
  double optimise(Point& p, const Limits& limits);

 private:
  static constexpr unsigned kMaxActive = 16;

  void reserve(std::size_t size);
  unsigned find_active(const Point& p, double worst, double width);
  double ascend(Point& p, double& best, double width, double length, double& step);
  void add_gradients(std::size_t tet, const Point& p, double band, unsigned& count);
  double local_length(const Point& p) const;

  std::size_t size_ = 0;
  std::size_t capacity_ = 0;  // of each array below
  // Structure of arrays: corners, normal of the triangle with offset, squared normal, squared
  // edges.
  enum Field { ax, ay, az, bx, by, bz, cx, cy, cz, nx, ny, nz, n2, ab2, bc2, ca2, kFields };
  std::vector<double> data_;
  std::vector<double> quality_;
  std::array<Point, kMaxActive> gradients_;

  double* field(Field f) { return data_.data() + static_cast<std::size_t>(f) * capacity_; }
  const double* field(Field f) const {
    return data_.data() + static_cast<std::size_t>(f) * capacity_;
  }
};

/// Shortest vector in the convex hull of `count` points. Source: Wolfe's method, in the form of an
/// active simplex of at most four points.
Point shortest_in_hull(const Point* points, unsigned count);

}  // namespace tetmend
