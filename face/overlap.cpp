// SPDX-License-Identifier: MIT
#include "face/overlap.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "kernel/geometry.h"

namespace tetmend::face {

namespace {

using TetPoints = std::array<Point, 4>;

/// Appends the tets that make up the part of `tet` where `height` is positive. `height` has the
/// heights of its vertices.
void cut(const TetPoints& tet, const std::array<double, 4>& height, std::vector<TetPoints>& parts) {
  std::array<std::size_t, 4> order{};  // first those above
  std::size_t above = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (height[i] > 0) order[above++] = i;
  }
  std::size_t next = above;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(height[i] > 0)) order[next++] = i;
  }
  if (above == 0) return;
  if (above == 4) {
    parts.push_back(tet);
    return;
  }
  const auto at = [&](std::size_t k) -> const Point& { return tet[order[k]]; };
  const auto crossing = [&](std::size_t k, std::size_t l) -> Point {
    const double share = height[order[k]] / (height[order[k]] - height[order[l]]);
    return at(k) + share * (at(l) - at(k));
  };
  if (above == 1) {
    parts.push_back({at(0), crossing(0, 1), crossing(0, 2), crossing(0, 3)});
    return;
  }
  // A prism: two triangles (or, above two vertices, two of its edges with them) face each other.
  std::array<Point, 3> one;
  std::array<Point, 3> other;
  if (above == 2) {
    one = {at(0), crossing(0, 2), crossing(0, 3)};
    other = {at(1), crossing(1, 2), crossing(1, 3)};
  } else {
    one = {at(0), at(1), at(2)};
    other = {crossing(0, 3), crossing(1, 3), crossing(2, 3)};
  }
  parts.push_back({one[0], one[1], one[2], other[2]});
  parts.push_back({one[0], one[1], other[1], other[2]});
  parts.push_back({one[0], other[0], other[1], other[2]});
}

double volume(const TetPoints& t) {
  return std::abs(volume6(t[0], t[1], t[2], t[3])) / 6;
}

}  // namespace

double overlap(const std::array<Point, 4>& a, const std::array<Point, 4>& b) {
  std::vector<TetPoints> parts = {a};
  std::vector<TetPoints> left;
  for (std::size_t k = 0; k < 4 && !parts.empty(); ++k) {
    const Point& p = b[(k + 1) % 4];
    Point normal = (b[(k + 2) % 4] - p).cross(b[(k + 3) % 4] - p);
    if (normal.dot(b[k] - p) < 0) normal = -normal;  // towards the vertex opposite
    left.clear();
    for (const TetPoints& part : parts) {
      std::array<double, 4> height{};
      for (std::size_t i = 0; i < 4; ++i) height[i] = normal.dot(part[i] - p);
      cut(part, height, left);
    }
    std::swap(parts, left);
  }
  double sum = 0;
  for (const TetPoints& part : parts) sum += volume(part);
  return sum;
}

}  // namespace tetmend::face
