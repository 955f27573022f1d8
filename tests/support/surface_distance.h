// SPDX-License-Identifier: MIT
// How far two surfaces are apart, by samples alone. Shares no code with envelope/: it is to find
// what that got wrong.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "kernel/mesh_data.h"
#include "tests/support/tets.h"

namespace tetmend::test {

inline double segment_distance(const Point& p, const Point& a, const Point& b) {
  const Point d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

/// To the plane where the foot lies inside, else to the sides.
inline double triangle_distance(const Point& p, const Triangle& t) {
  const Point n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = n.norm();
  if (area > 0) {
    const Point unit = n / area;
    bool inside = true;
    for (unsigned k = 0; k < 3; ++k) {
      const Point side = t[(k + 1) % 3] - t[k];
      if (unit.dot(side.cross(p - t[k])) < 0) inside = false;
    }
    if (inside) return std::abs(unit.dot(p - t[0]));
  }
  return std::min({segment_distance(p, t[0], t[1]), segment_distance(p, t[1], t[2]),
                   segment_distance(p, t[2], t[0])});
}

/// Triangles in the cells of a grid.
class TriangleGrid {
 public:
  explicit TriangleGrid(const std::vector<Triangle>& triangles) : triangles_(triangles) {
    low_ = Point::Constant(std::numeric_limits<double>::infinity());
    Point high = -low_;
    for (const Triangle& t : triangles) {
      for (const Point& p : t) {
        low_ = low_.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    const double size = (high - low_).maxCoeff();
    n_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(triangles.size()) / 2)), 1, 64);
    width_ = size > 0 ? size / n_ * (1 + 1e-9) : 1;
    cells_.resize(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_) *
                  static_cast<std::size_t>(n_));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      Point a = triangles[i][0].cwiseMin(triangles[i][1]).cwiseMin(triangles[i][2]);
      Point b = triangles[i][0].cwiseMax(triangles[i][1]).cwiseMax(triangles[i][2]);
      const auto from = cell(a);
      const auto to = cell(b);
      for (int x = from[0]; x <= to[0]; ++x) {
        for (int y = from[1]; y <= to[1]; ++y) {
          for (int z = from[2]; z <= to[2]; ++z) at(x, y, z).push_back(i);
        }
      }
    }
  }

  /// Distance of the nearest triangle, looked for in rings of cells around the point.
  double distance(const Point& p) const {
    double best = std::numeric_limits<double>::infinity();
    const auto home = cell(p);
    for (int ring = 0; ring < n_; ++ring) {
      if (best <= (ring - 1) * width_) break;
      for (int x = home[0] - ring; x <= home[0] + ring; ++x) {
        for (int y = home[1] - ring; y <= home[1] + ring; ++y) {
          for (int z = home[2] - ring; z <= home[2] + ring; ++z) {
            const bool border = std::abs(x - home[0]) == ring || std::abs(y - home[1]) == ring ||
                                std::abs(z - home[2]) == ring;
            if (!border || x < 0 || y < 0 || z < 0 || x >= n_ || y >= n_ || z >= n_) continue;
            for (const std::size_t i : at(x, y, z)) {
              best = std::min(best, triangle_distance(p, triangles_[i]));
            }
          }
        }
      }
    }
    return best;
  }

 private:
  std::array<int, 3> cell(const Point& p) const {
    std::array<int, 3> c{};
    for (int k = 0; k < 3; ++k) {
      c[static_cast<std::size_t>(k)] =
          std::clamp(static_cast<int>((p[k] - low_[k]) / width_), 0, n_ - 1);
    }
    return c;
  }
  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>((x * n_ + y) * n_ + z);
  }
  std::vector<std::size_t>& at(int x, int y, int z) { return cells_[index(x, y, z)]; }
  const std::vector<std::size_t>& at(int x, int y, int z) const { return cells_[index(x, y, z)]; }

  const std::vector<Triangle>& triangles_;
  Point low_;
  double width_ = 1;
  int n_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

/// Largest distance from one surface to the other, at (side + 1) (side + 2) / 2 points of each
/// triangle: 105 for 13.
inline double sampled_distance(const std::vector<Triangle>& from, const std::vector<Triangle>& to,
                               int side = 13) {
  const TriangleGrid grid(to);
  double most = 0;
  for (const Triangle& t : from) {
    for (int i = 0; i <= side; ++i) {
      for (int j = 0; i + j <= side; ++j) {
        const Point p = t[0] + (t[1] - t[0]) * i / side + (t[2] - t[0]) * j / side;
        most = std::max(most, grid.distance(p));
      }
    }
  }
  return most;
}

inline double total_area(const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += (t[1] - t[0]).cross(t[2] - t[0]).norm() / 2;
  return sum;
}

/// Of what a closed surface of outward triangles encloses.
inline double enclosed_volume(const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += t[0].dot(t[1].cross(t[2])) / 6;
  return sum;
}

}  // namespace tetmend::test
