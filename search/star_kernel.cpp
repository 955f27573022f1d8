// SPDX-License-Identifier: MIT
//   p sees a face if n.p - d > 0, with its normal n and d = n.a. With p = x / w that is
//   (n, -d).(x, w) > 0, and (0, 1).(x, w) > 0. Such (x, w) exists unless 0 lies in the hull of the
//   rows (n, -d) and (0, 1); the point of the hull nearest to 0 is one.
#include "search/star_kernel.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace tetmend {

namespace {

using Row = Eigen::Vector4d;

/// A simplex of rows, and the weights of a point in it.
struct Corral {
  std::vector<Row> rows;
  std::vector<double> weights;

  Row point() const {
    Row sum = Row::Zero();
    for (std::size_t i = 0; i < rows.size(); ++i) sum += weights[i] * rows[i];
    return sum;
  }

  /// Weights of the point nearest to 0 in the plane through the rows.
  Eigen::VectorXd nearest_in_plane() const {
    const auto n = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Ones(n + 1, n + 1);
    system(n, n) = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        system(i, j) = rows[static_cast<std::size_t>(i)].dot(rows[static_cast<std::size_t>(j)]);
      }
    }
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
    right(n) = 1;
    return system.fullPivLu().solve(right).head(n);
  }

  /// Goes to the nearest point of the simplex, and drops the rows that it does not need.
  void approach() {
    while (true) {
      const Eigen::VectorXd aim = nearest_in_plane();
      double share = 1;  // of the way that stays in the simplex
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double a = aim(static_cast<Eigen::Index>(i));
        if (a <= 0) share = std::min(share, weights[i] / std::max(weights[i] - a, 1e-300));
      }
      std::vector<Row> kept;
      std::vector<double> kept_weights;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double weight = weights[i] + share * (aim(static_cast<Eigen::Index>(i)) - weights[i]);
        if (!(weight > 1e-14)) continue;
        kept.push_back(rows[i]);
        kept_weights.push_back(weight);
      }
      const bool is_there = kept.size() == rows.size() || kept.empty();
      rows.swap(kept);
      weights.swap(kept_weights);
      if (is_there) return;
    }
  }
};

}  // namespace

bool has_kernel(std::span<const std::array<Point, 3>> faces) {
  constexpr int kSteps = 200;
  constexpr double kNear = 1e-10;  // to 0: the hull holds it, as far as can be told
  if (faces.empty()) return true;
  Point low = faces[0][0];
  Point high = low;
  for (const auto& face : faces) {
    for (const Point& p : face) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  const double size = (high - low).maxCoeff();
  if (!(size > 0)) return false;
  std::vector<Row> rows = {Row(0, 0, 0, 1)};
  for (const auto& face : faces) {
    const Point a = (face[0] - low) / size;
    const Point b = (face[1] - low) / size;
    const Point c = (face[2] - low) / size;
    const Point n = (b - a).cross(c - a);
    if (!(n.squaredNorm() > 0)) return false;
    rows.push_back(Row(n.x(), n.y(), n.z(), -n.dot(a)).normalized());
  }
  Corral corral = {{rows[0]}, {1}};
  for (int step = 0; step < kSteps; ++step) {
    const Row x = corral.point();
    if (!(x.norm() > kNear)) return false;
    const auto by_side = [&](const Row& r, const Row& s) { return r.dot(x) < s.dot(x); };
    const Row last = *std::min_element(rows.begin(), rows.end(), by_side);
    if (last.dot(x) > 0) return true;
    corral.rows.push_back(last);
    corral.weights.push_back(0);
    corral.approach();
    if (corral.rows.empty()) return false;
  }
  return false;
}

}  // namespace tetmend
