// SPDX-License-Identifier: MIT
// The best bend of an edge: where its mid-side node makes the worst of the curved tets around best.
//
// The Jacobian determinant of a tet is affine in the bend of one of its edges, for that changes the
// Jacobian by a matrix of rank one. So are its Bezier coefficients [johnen]. The least of them over all
// tets at the edge is concave in the bend and has one maximum.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

/// The least Bezier coefficient of the tets at an edge, by the determinant of each when it is straight,
/// as a function of the bend of the edge: 1 at most where all are straight, and none of these tets is
/// turned over where it is above 0.
class BendSearch {
 public:
  /// @param edge which of the bends, in VTK's order, is that of the edge
  /// Precondition: the straight tet is not inverted or flat.
  void add(const std::array<Point, 4>& vertices, const std::array<Point, 6>& bends,
           std::size_t edge);

  double value(const Point& bend) const;
  /// A bend with a value near the greatest, and no smaller than that of `start`. Cost: some thousand
  /// evaluations.
  Point best(const Point& start) const;
  /// A bend for which the coefficients miss `wanted` by less, in the sum of squares: where several edges
  /// must give way at once, none alone can raise the least. Cost: some dozen evaluations.
  Point eased(const Point& start, double wanted) const;

 private:
  /// value = constant + gradient . bend
  struct Plane {
    double constant;
    Point gradient;
  };

  double shortfall(const Point& bend, double wanted) const;
  Point ascent(const Point& bend, double softness) const;
  Point climb(const Point& bend, const Point& direction) const;

  std::vector<Plane> planes_;
  double length_ = 0;  // of the longest of the tets' edges
};

}  // namespace tetmend
