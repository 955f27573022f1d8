// SPDX-License-Identifier: MIT
#include "envelope/triangle_set.h"

#include <algorithm>
#include <utility>

namespace tetmend {

namespace {

std::array<double, 3> coordinates(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

bool comes_first(const TriangleSet::Corners& a, const TriangleSet::Corners& b) {
  for (unsigned k = 0; k < 3; ++k) {
    if (a[k] != b[k]) return coordinates(a[k]) < coordinates(b[k]);
  }
  return false;
}

/// From the least corner on.
TriangleSet::Corners rotated(TriangleSet::Corners points) {
  const auto least = std::min_element(
      points.begin(), points.end(),
      [](const Point& p, const Point& q) { return coordinates(p) < coordinates(q); });
  std::rotate(points.begin(), least, points.end());
  return points;
}

}  // namespace

TriangleSet::TriangleSet(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
  for (Corners& triangle : triangles_) triangle = rotated(triangle);
  std::sort(triangles_.begin(), triangles_.end(), comes_first);
}

bool TriangleSet::contains(const Corners& triangle) const {
  return std::binary_search(triangles_.begin(), triangles_.end(), rotated(triangle), comes_first);
}

}  // namespace tetmend
