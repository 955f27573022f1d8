// SPDX-License-Identifier: MIT
// Triangles and segments as convex sets: how far a point is from one, and which of many is nearest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "kernel/mesh_data.h"

namespace tetmend {

/// A triangle of a patch, or a segment of a line.
struct Element {
  std::array<Point, 3> points;  ///< of a segment two, and the second again
  unsigned corners = 3;         ///< 3, or 2 for a segment
  std::uint32_t sheet = 0;      ///< number of its patch or line
  double tolerance = 0;
  /// Unit normal, or direction of a segment. Zero where the element is too thin to have one.
  Point normal = Point::Zero();
};

/// Normal or direction; zero where the least height is under `thin`.
Point normal_of(const std::array<Point, 3>& points, unsigned corners, double thin);

/// The point between a and b that is nearest to p.
Point nearest_on_segment(const Point& a, const Point& b, const Point& p);
/// The point of the element that is nearest to p.
Point nearest_point(const std::array<Point, 3>& points, unsigned corners, const Point& p);
inline Point nearest_point(const Element& element, const Point& p) {
  return nearest_point(element.points, element.corners, p);
}

inline double triangle_area(const std::array<Point, 3>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
}

inline double mean_edge(const std::array<Point, 3>& p) {
  return ((p[1] - p[0]).norm() + (p[2] - p[1]).norm() + (p[0] - p[2]).norm()) / 3;
}

using Box = Eigen::AlignedBox<double, 3>;
Box box_of(const std::array<Point, 3>& points);
/// With all that lies within its tolerance.
Box box_around(const Element& element);

/// A tree of boxes for each sheet, in one array. Built the same way everywhere.
class ElementTree {
 public:
  ElementTree() = default;
  /// Element i belongs to sheet `sheet_of[i]`. Cost: n log n.
  ElementTree(std::span<const Element> elements, std::span<const std::uint32_t> sheet_of,
              std::size_t sheets);

  struct Nearest {
    std::uint32_t element = 0;
    Point point = Point::Zero();
    double distance2 = std::numeric_limits<double>::infinity();
  };
  /// In a sheet that has elements; of several equally near ones the first.
  Nearest nearest(std::span<const Element> elements, std::uint32_t sheet, const Point& p) const;
  /// Appends the elements of a sheet whose box_around() meets the box, ascending.
  void find(std::span<const Element> elements, std::uint32_t sheet, const Box& box,
            std::vector<std::uint32_t>& out) const;

 private:
  struct Node {
    Box box;
    std::uint32_t begin, end;  // in order_
    std::uint32_t second = 0;  // the other child; the first one follows. 0: a leaf
  };
  void build(std::span<const Element> elements, std::uint32_t begin, std::uint32_t end);

  static constexpr std::uint32_t kLeaf = 4;
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFFu;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> roots_;  // by sheet
};

}  // namespace tetmend
