// SPDX-License-Identifier: MIT
#include "search/mean_ratio_ball.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "kernel/geometry.h"

namespace tetmend {

void MeanRatioBall::clear(const Point& origin) {
  origin_ = origin;
  sides_.clear();
}

void MeanRatioBall::add(const Point& a, const Point& b, const Point& c) {
  const Point u = a - origin_;
  const Point v = b - origin_;
  const Point w = c - origin_;
  const Point normal = (v - u).cross(w - u);
  sides_.push_back({normal, u.dot(normal), u + v + w,
                    u.squaredNorm() + v.squaredNorm() + w.squaredNorm() + (v - u).squaredNorm() +
                        (w - u).squaredNorm() + (w - v).squaredNorm()});
}

// mean ratio = 12 (V6 / 2)^(2/3) / S, S the sum of the squared edges
double MeanRatioBall::mean(const Point& p) const {
  const Point x = p - origin_;
  double sum = 0;
  for (const Side& side : sides_) {
    const double v6 = side.offset - side.normal.dot(x);
    if (!(v6 > 0)) return 0;
    const double root = cube_root(v6 / 2);
    sum += 12 * root * root / (3 * x.squaredNorm() - 2 * side.sum.dot(x) + side.squares);
  }
  return sides_.empty() ? 0 : sum / static_cast<double>(sides_.size());
}

/// Sum of S / V6^(2/3), with p relative to the origin.
double MeanRatioBall::value(const Point& p) const {
  double sum = 0;
  for (const Side& side : sides_) {
    const double v6 = side.offset - side.normal.dot(p);
    if (!(v6 > 0)) return std::numeric_limits<double>::infinity();
    const double root = cube_root(v6);
    sum += (3 * p.squaredNorm() - 2 * side.sum.dot(p) + side.squares) / (root * root);
  }
  return sum;
}

MeanRatioBall::Slope MeanRatioBall::slope(const Point& p) const {
  Slope result;
  for (const Side& side : sides_) {
    const double v6 = side.offset - side.normal.dot(p);
    if (!(v6 > 0)) {
      result.value = std::numeric_limits<double>::infinity();
      return result;
    }
    const double root = cube_root(v6);
    const double power = 1 / (root * root);
    const double s = 3 * p.squaredNorm() - 2 * side.sum.dot(p) + side.squares;
    const Point along = 6 * p - 2 * side.sum;  // gradient of S; that of V6 is -normal
    const double by_volume = power / (1.5 * v6);
    result.value += s * power;
    result.gradient += power * along + s * by_volume * side.normal;
    result.hessian.diagonal().array() += 6 * power;
    result.hessian +=
        by_volume * (along * side.normal.transpose() + side.normal * along.transpose());
    result.hessian += (5.0 / 3 * s * by_volume / v6) * side.normal * side.normal.transpose();
  }
  return result;
}

Point MeanRatioBall::descend(const Point& p, int steps) const {
  constexpr int kHalvings = 4;
  constexpr double kLeastGain = 1e-4;  // share of the value
  Point x = p - origin_;
  Slope here = slope(x);
  for (int step = 0; step < steps && std::isfinite(here.value); ++step) {
    const Eigen::LDLT<Eigen::Matrix3d> factors(here.hessian);
    Point way = -factors.solve(here.gradient);
    if (!factors.isPositive() || !(way.dot(here.gradient) < 0)) {
      way = -here.gradient * (here.value / (here.gradient.squaredNorm() * 10));
    }
    double reached = here.value;
    double share = 1;
    for (int i = 0; i < kHalvings; ++i, share /= 2) {
      reached = value(x + share * way);
      if (reached < here.value) break;
    }
    if (!(reached < here.value)) break;
    x += share * way;
    if (reached > (1 - kLeastGain) * here.value) break;
    if (step + 1 < steps) here = slope(x);
  }
  return origin_ + x;
}

}  // namespace tetmend
