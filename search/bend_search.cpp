// SPDX-License-Identifier: MIT
#include "search/bend_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "kernel/curved.h"
#include "kernel/second_order.h"

namespace tetmend {

void BendSearch::add(const std::array<Point, 4>& vertices, const std::array<Point, 6>& bends,
                     std::size_t edge) {
  std::array<Point, 6> none;
  none.fill(Point::Zero());
  const double straight = jacobian_coefficients(vertices, none)[0];
  for (const auto& [a, b] : kMidNodeEdges) {
    length_ = std::max(length_, (vertices[b] - vertices[a]).norm());
  }
  const double step = length_;
  std::array<Point, 6> bent = bends;
  bent[edge] = Point::Zero();
  const std::array<double, 20> constants = jacobian_coefficients(vertices, bent);
  const std::size_t first = planes_.size();
  for (const double constant : constants) {
    planes_.push_back({constant / straight, Point::Zero()});
  }
  for (int axis = 0; axis < 3; ++axis) {
    bent[edge] = Point::Unit(axis) * step;
    const std::array<double, 20> moved = jacobian_coefficients(vertices, bent);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      planes_[first + i].gradient[axis] = (moved[i] - constants[i]) / (straight * step);
    }
  }
}

double BendSearch::value(const Point& bend) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes_) {
    least = std::min(least, plane.constant + plane.gradient.dot(bend));
  }
  return least;
}

/// The gradient of the least value, softened to a mean of those near it.
Point BendSearch::ascent(const Point& bend, double softness) const {
  const double least = value(bend);
  Point sum = Point::Zero();
  double weights = 0;
  for (const Plane& plane : planes_) {
    const double above = plane.constant + plane.gradient.dot(bend) - least;
    const double weight = std::exp(-above / softness);
    sum += weight * plane.gradient;
    weights += weight;
  }
  return sum / weights;
}

/// The best bend in this direction, no farther than the length of an edge.
Point BendSearch::climb(const Point& bend, const Point& direction) const {
  constexpr double kShare = 0.6180339887498949;
  constexpr int kSteps = 40;
  const double length = direction.norm();
  if (!(length > 0)) return bend;
  const Point along = direction * (length_ / length);
  double low = 0;
  double high = 1;
  for (int i = 0; i < kSteps; ++i) {
    const double left = high - kShare * (high - low);
    const double right = low + kShare * (high - low);
    const bool is_right = value(bend + left * along) < value(bend + right * along);
    (is_right ? low : high) = is_right ? left : right;
  }
  return bend + low * along;
}

Point BendSearch::best(const Point& start) const {
  constexpr std::array<double, 5> kSoftness = {0.3, 0.1, 0.03, 0.01, 0.003};
  constexpr int kSteps = 12;
  Point best = start;
  double most = value(start);
  for (const double softness : kSoftness) {
    for (int i = 0; i < kSteps; ++i) {
      const Point next = climb(best, ascent(best, softness));
      const double reached = value(next);
      if (!(reached > most + 1e-9)) break;
      best = next;
      most = reached;
    }
  }
  return best;
}

double BendSearch::shortfall(const Point& bend, double wanted) const {
  double sum = 0;
  for (const Plane& plane : planes_) {
    const double missing = wanted - plane.constant - plane.gradient.dot(bend);
    if (missing > 0) sum += missing * missing;
  }
  return sum;
}

/// Newton's method: the sum of squares is convex in the bend.
Point BendSearch::eased(const Point& start, double wanted) const {
  constexpr int kSteps = 6;
  constexpr int kHalvings = 6;
  Point bend = start;
  double least = shortfall(bend, wanted);
  for (int i = 0; i < kSteps && least > 0; ++i) {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    Point slope = Point::Zero();
    for (const Plane& plane : planes_) {
      const double missing = wanted - plane.constant - plane.gradient.dot(bend);
      if (!(missing > 0)) continue;
      squares += plane.gradient * plane.gradient.transpose();
      slope += missing * plane.gradient;
    }
    squares += 1e-9 * squares.trace() * Eigen::Matrix3d::Identity();
    Point step = squares.ldlt().solve(slope);
    if (!step.allFinite()) break;
    double reached = shortfall(bend + step, wanted);
    for (int k = 0; k < kHalvings && !(reached < least); ++k) {
      step /= 2;
      reached = shortfall(bend + step, wanted);
    }
    if (!(reached < least)) break;
    bend += step;
    least = reached;
  }
  return bend;
}

}  // namespace tetmend
