// SPDX-License-Identifier: MIT
// Which triangles of a surface lie in one plane.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tetmend/api.h>

#include "kernel/mesh_data.h"

namespace tetmend {

/// A plane with a unit normal; a zero normal stands for a triangle without area.
struct Plane {
  Point origin = Point::Zero();
  Point normal = Point::Zero();

  double height(const Point& p) const { return normal.dot(p - origin); }
};

struct Planes {
  std::vector<Plane> planes;
  std::vector<std::uint32_t> plane_of;  ///< of each triangle
};

/// Divides triangles into connected sets that lie within `tolerance` of a plane and turn the same
/// way in it. `neighbours` has for each side of each triangle the one behind it, or itself. Cost:
/// sorting by area.
Planes find_planes(std::span<const std::array<Point, 3>> triangles,
                   std::span<const std::uint32_t> neighbours, double tolerance);

/// 1 or -1 if that is for certain the sense of triangle (a, b, c) as seen against `normal`; 0 if it
/// is too close to tell. Exact up to the projection along the largest coordinate of `normal`.
TETMEND_API int certified_sense(const std::array<Point, 3>& triangle, const Point& normal);

}  // namespace tetmend
