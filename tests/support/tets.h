// SPDX-License-Identifier: MIT
// Single tets and triangles, by their corners.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"

namespace tetmend::test {

using Triangle = std::array<Point, 3>;
using TetPoints = std::array<Point, 4>;

/// The vertex numbers of a tet, ascending.
using Corners = std::array<std::uint32_t, 4>;

inline constexpr double kDegree = std::numbers::pi / 180;  ///< in radians

/// Around the origin; without an edge, one of corners whose coordinates are 1 and -1.
inline TetPoints regular_tet(double edge = std::sqrt(8.0)) {
  const double a = edge / std::sqrt(8.0);
  return {Point(a, a, a), Point(-a, a, -a), Point(a, -a, -a), Point(-a, -a, a)};
}

/// The longest edge of a tet by its shortest.
inline double edge_ratio(const Point& a, const Point& b, const Point& c, const Point& d) {
  const std::array lengths = {(b - a).norm(), (c - a).norm(), (d - a).norm(),
                              (c - b).norm(), (d - b).norm(), (d - c).norm()};
  const auto [least, greatest] = std::minmax_element(lengths.begin(), lengths.end());
  return *greatest / *least;
}

/// A mesh of one tet.
inline MeshData single_tet(const Point& a, const Point& b, const Point& c, const Point& d) {
  MeshData data;
  data.points = {a, b, c, d};
  data.tets = {{{0, 1, 2, 3}}};
  return data;
}

/// By the numbers of its vertices.
inline TetVertices tet_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return {VertexHandle(a), VertexHandle(b), VertexHandle(c), VertexHandle(d)};
}

}  // namespace tetmend::test
