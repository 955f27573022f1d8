// SPDX-License-Identifier: MIT
#include "envelope/element.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tetmend {

Point normal_of(const std::array<Point, 3>& points, unsigned corners, double thin) {
  const Point a = points[1] - points[0];
  if (corners == 2) return a.norm() > thin ? Point(a.normalized()) : Point::Zero();
  const Point n = a.cross(points[2] - points[0]);
  const double longest =
      std::max({a.norm(), (points[2] - points[1]).norm(), (points[0] - points[2]).norm()});
  const double area = n.norm();
  return area > thin * longest ? Point(n / area) : Point::Zero();
}

Point nearest_on_segment(const Point& a, const Point& b, const Point& p) {
  const Point d = b - a;
  const double length2 = d.squaredNorm();
  const double t = (p - a).dot(d);
  if (!(t > 0)) return a;
  return t >= length2 ? b : Point(a + t / length2 * d);
}

/// [ericson_collision, 5.1.5]: the region of the plane that p lies over decides. Signs of areas come
/// from cross products: products of its dot products cancel in needles.
Point nearest_point(const std::array<Point, 3>& points, unsigned corners, const Point& p) {
  const auto& [a, b, c] = points;
  if (corners == 2) return nearest_on_segment(a, b, p);
  const Point ab = b - a;
  const Point ac = c - a;
  const Point ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Point bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const Point n = ab.cross(ac);
  if (d1 >= 0 && d3 <= 0 && n.dot(ap.cross(bp)) <= 0) return nearest_on_segment(a, b, p);
  const Point cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  if (d2 >= 0 && d6 <= 0 && n.dot(cp.cross(ap)) <= 0) return nearest_on_segment(a, c, p);
  if (d4 - d3 >= 0 && d5 - d6 >= 0 && n.dot(bp.cross(cp)) <= 0) return nearest_on_segment(b, c, p);
  const double n2 = n.squaredNorm();
  return n2 > 0 ? Point(p - n.dot(ap) / n2 * n) : nearest_on_segment(a, b, p);
}

Box box_of(const std::array<Point, 3>& points) {
  Box box(points[0]);
  box.extend(points[1]);
  box.extend(points[2]);
  return box;
}

Box box_around(const Element& element) {
  const Box box = box_of(element.points);
  const Point reach = Point::Constant(element.tolerance);
  return {box.min() - reach, box.max() + reach};
}

ElementTree::ElementTree(std::span<const Element> elements, std::span<const std::uint32_t> sheet_of,
                         std::size_t sheets)
    : order_(elements.size()), roots_(sheets, kEmpty) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return sheet_of[a] < sheet_of[b]; });
  nodes_.reserve(elements.size());
  for (std::uint32_t begin = 0; begin < order_.size();) {
    std::uint32_t end = begin;
    while (end < order_.size() && sheet_of[order_[end]] == sheet_of[order_[begin]]) ++end;
    roots_[sheet_of[order_[begin]]] = static_cast<std::uint32_t>(nodes_.size());
    build(elements, begin, end);
    begin = end;
  }
}

void ElementTree::build(std::span<const Element> elements, std::uint32_t begin, std::uint32_t end) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  Box box;
  Box middles;
  const auto middle = [&](std::uint32_t i) -> Point { return box_of(elements[i].points).center(); };
  for (std::uint32_t i = begin; i < end; ++i) {
    box.extend(box_around(elements[order_[i]]));
    middles.extend(middle(order_[i]));
  }
  nodes_.push_back({box, begin, end});
  if (end - begin <= kLeaf) {
    std::sort(order_.begin() + begin, order_.begin() + end);
    return;
  }
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = middle(a)[axis];
                     const double y = middle(b)[axis];
                     return x != y ? x < y : a < b;
                   });
  build(elements, begin, half);
  nodes_[number].second = static_cast<std::uint32_t>(nodes_.size());
  build(elements, half, end);
}

ElementTree::Nearest ElementTree::nearest(std::span<const Element> elements, std::uint32_t sheet,
                                          const Point& p) const {
  Nearest best;
  std::array<std::uint32_t, 64> stack{};
  std::size_t size = 0;
  if (roots_[sheet] != kEmpty) stack[size++] = roots_[sheet];
  while (size > 0) {
    const std::uint32_t n = stack[--size];
    const Node& node = nodes_[n];
    if (node.box.squaredExteriorDistance(p) > best.distance2) continue;
    if (node.second != 0) {
      const double near = nodes_[n + 1].box.squaredExteriorDistance(p);
      const double far = nodes_[node.second].box.squaredExteriorDistance(p);
      stack[size++] = near <= far ? node.second : n + 1;  // the nearer one comes first
      stack[size++] = near <= far ? n + 1 : node.second;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Point q = nearest_point(elements[order_[i]], p);
      const double distance2 = (q - p).squaredNorm();
      if (distance2 < best.distance2 || (distance2 == best.distance2 && order_[i] < best.element)) {
        best = {order_[i], q, distance2};
      }
    }
  }
  return best;
}

void ElementTree::find(std::span<const Element> elements, std::uint32_t sheet, const Box& box,
                       std::vector<std::uint32_t>& out) const {
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  std::array<std::uint32_t, 64> stack{};
  std::size_t size = 0;
  if (roots_[sheet] != kEmpty) stack[size++] = roots_[sheet];
  while (size > 0) {
    const std::uint32_t n = stack[--size];
    const Node& node = nodes_[n];
    if (!node.box.intersects(box)) continue;
    if (node.second != 0) {
      stack[size++] = node.second;
      stack[size++] = n + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (box_around(elements[order_[i]]).intersects(box)) out.push_back(order_[i]);
    }
  }
  std::sort(out.begin() + first, out.end());
}

}  // namespace tetmend
