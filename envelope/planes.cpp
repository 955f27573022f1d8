// SPDX-License-Identifier: MIT
// Planes grow from the largest triangles, which know their normals best. A plane is laid anew
// through what it has reached, for the sum of many areas knows the normal better still.
#include "envelope/planes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

namespace tetmend {

namespace {

constexpr std::uint32_t kNoPlane = 0xFFFFFFFFu;

Point area_vector(const std::array<Point, 3>& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

class PlaneFinder {
 public:
  PlaneFinder(std::span<const std::array<Point, 3>> triangles,
              std::span<const std::uint32_t> neighbours, double tolerance)
      : triangles_(triangles), neighbours_(neighbours), tolerance_(tolerance) {}

  Planes find() {
    const std::size_t n = triangles_.size();
    found_.plane_of.assign(n, kNoPlane);
    mark_.assign(n, kNoPlane);
    std::vector<double> area(n);
    for (std::size_t i = 0; i < n; ++i) area[i] = area_vector(triangles_[i]).norm();
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return area[a] > area[b]; });
    for (const std::uint32_t seed : order) {
      if (found_.plane_of[seed] == kNoPlane) add(seed, area[seed]);
    }
    return std::move(found_);
  }

 private:
  void add(std::uint32_t seed, double area) {
    const auto number = static_cast<std::uint32_t>(found_.planes.size());
    Plane plane{triangles_[seed][0], Point::Zero()};
    if (area > 0) plane.normal = area_vector(triangles_[seed]) / area;
    reached_.assign(1, seed);
    if (!plane.normal.isZero() && certified_sense(triangles_[seed], plane.normal) > 0) {
      grow(seed, plane, 100 * tolerance_);
      const Plane better = fit();
      const bool all = std::all_of(reached_.begin(), reached_.end(),
                                   [&](std::uint32_t i) { return lies_in(i, better, tolerance_); });
      if (all) {
        plane = better;
      } else {
        grow(seed, plane, tolerance_);
      }
    } else {
      plane.normal.setZero();
    }
    for (const std::uint32_t i : reached_) found_.plane_of[i] = number;
    found_.planes.push_back(plane);
  }

  bool lies_in(std::uint32_t i, const Plane& plane, double tolerance) const {
    return std::all_of(triangles_[i].begin(), triangles_[i].end(),
                       [&](const Point& p) { return std::abs(plane.height(p)) <= tolerance; }) &&
           certified_sense(triangles_[i], plane.normal) > 0;
  }

  /// Fills reached_ with what is joined to the seed and lies in the plane.
  void grow(std::uint32_t seed, const Plane& plane, double tolerance) {
    const std::uint32_t stamp = stamp_++;
    reached_.assign(1, seed);
    mark_[seed] = stamp;
    for (std::size_t next = 0; next < reached_.size(); ++next) {
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t i = neighbours_[3 * reached_[next] + k];
        if (mark_[i] == stamp || found_.plane_of[i] != kNoPlane) continue;
        mark_[i] = stamp;
        if (lies_in(i, plane, tolerance)) reached_.push_back(i);
      }
    }
  }

  Plane fit() const {
    Point sum = Point::Zero();
    Point middle = Point::Zero();
    for (const std::uint32_t i : reached_) {
      sum += area_vector(triangles_[i]);
      middle += (triangles_[i][0] + triangles_[i][1] + triangles_[i][2]) / 3;
    }
    Plane plane{triangles_[reached_[0]][0], sum.normalized()};
    // A plane across an axis has it exactly: then its points are found without rounding.
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const bool same = std::all_of(reached_.begin(), reached_.end(), [&](std::uint32_t i) {
        return std::all_of(triangles_[i].begin(), triangles_[i].end(),
                           [&](const Point& p) { return p[axis] == plane.origin[axis]; });
      });
      if (same) {
        plane.normal = Point::Unit(axis) * (plane.normal[axis] < 0 ? -1 : 1);
        return plane;
      }
    }
    middle /= static_cast<double>(reached_.size());
    plane.origin = middle;
    return plane;
  }

  std::span<const std::array<Point, 3>> triangles_;
  std::span<const std::uint32_t> neighbours_;
  double tolerance_;
  Planes found_;
  std::vector<std::uint32_t> mark_;
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> reached_;
};

}  // namespace

Planes find_planes(std::span<const std::array<Point, 3>> triangles,
                   std::span<const std::uint32_t> neighbours, double tolerance) {
  return PlaneFinder(triangles, neighbours, tolerance).find();
}

int certified_sense(const std::array<Point, 3>& triangle, const Point& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const auto u = static_cast<Eigen::Index>((axis + 1) % 3);
  const auto v = static_cast<Eigen::Index>((axis + 2) % 3);
  const Point a = triangle[1] - triangle[0];
  const Point b = triangle[2] - triangle[0];
  const double left = a[u] * b[v];
  const double right = a[v] * b[u];
  // As in kernel/geometry.h: the filter of [shewchuk_predicates], for the plane.
  const double error = 4.5e-16 * (std::abs(left) + std::abs(right)) + 1e-300;
  const double area = normal[axis] < 0 ? right - left : left - right;
  return area > error ? 1 : area < -error ? -1 : 0;
}

}  // namespace tetmend
