// SPDX-License-Identifier: MIT
// Convex polygons cut by planes: faces of tets and cross-sections of tets.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "viewer/mesh/visibility.h"

namespace tetmend::viewer {

/// A small convex polygon. Side i runs from corner i to the next; `drawn` says whether it is an
/// edge worth a line or only the border of a cut.
struct Polygon {
  static constexpr unsigned kMost = 8;  ///< a quadrilateral or triangle cut by three planes
  std::array<glm::dvec3, kMost> corners;
  std::array<bool, kMost> drawn{};
  unsigned size = 0;

  void add(const glm::dvec3& corner, bool is_drawn) {
    corners[size] = corner;
    drawn[size] = is_drawn;
    ++size;
  }
};

/// What is left below the plane; maybe nothing. The new side is drawn if `draw_cut`.
Polygon clip(const Polygon& polygon, const Plane& plane, bool draw_cut);

/// The cut of a tet (its four corners, in positive order) with a plane, counterclockwise as seen
/// from above the plane; empty when the plane misses it.
Polygon cross_section(const std::array<glm::dvec3, 4>& tet, const Plane& plane);

}  // namespace tetmend::viewer
