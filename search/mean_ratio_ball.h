// SPDX-License-Identifier: MIT
// Where to put a vertex so that the tets of its ball are round on average. A pure unit: points in,
// point out.
#pragma once

#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

/// Minimises the sum of 1 / mean ratio over a ball, given by the triangles of its link: smooth, and
/// infinite where a tet is flat. Source: [knupp], by Newton's method.
class MeanRatioBall {
 public:
  /// Begins a ball. Coordinates are taken relative to `origin`, best near the vertex.
  void clear(const Point& origin);
  /// A link triangle; (p, a, b, c) is positive for a vertex p inside the ball.
  void add(const Point& a, const Point& b, const Point& c);

  /// Mean of the mean ratios with the vertex at p; 0 if a tet is not positive then. Cost: linear.
  double mean(const Point& p) const;
  /// Goes down from p in that many steps at most. Returns the place reached; p if none is better or
  /// a tet is not positive there. Cost: linear in the tets for each step.
  Point descend(const Point& p, int steps) const;

 private:
  struct Side {
    Point normal;    // (b - a) x (c - a)
    double offset;   // V6 = offset - normal p
    Point sum;       // a + b + c
    double squares;  // sum of squared edges = 3 |p|^2 - 2 sum p + squares
  };
  struct Slope {
    double value = 0;
    Point gradient = Point::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  };

  double value(const Point& p) const;
  Slope slope(const Point& p) const;

  Point origin_ = Point::Zero();
  std::vector<Side> sides_;
};

}  // namespace tetmend
