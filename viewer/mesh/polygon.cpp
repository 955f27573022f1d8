// SPDX-License-Identifier: MIT
#include "viewer/mesh/polygon.h"

#include <algorithm>

namespace tetmend::viewer {

namespace {

/// Where the segment from p (height a) to q (height b) meets height 0.
glm::dvec3 crossing(const glm::dvec3& p, double a, const glm::dvec3& q, double b) {
  return p + (a / (a - b)) * (q - p);
}

}  // namespace

Polygon clip(const Polygon& polygon, const Plane& plane, bool draw_cut) {
  Polygon out;
  for (unsigned i = 0; i < polygon.size; ++i) {
    const glm::dvec3& p = polygon.corners[i];
    const glm::dvec3& q = polygon.corners[i + 1 == polygon.size ? 0 : i + 1];
    const double a = plane.height(p);
    const double b = plane.height(q);
    if (a <= 0) out.add(p, polygon.drawn[i]);
    if (a < 0 && b > 0) out.add(crossing(p, a, q, b), draw_cut);
    if (a > 0 && b < 0) out.add(crossing(p, a, q, b), polygon.drawn[i]);
    if (out.size > 0 && a == 0 && b > 0) out.drawn[out.size - 1] = draw_cut;
  }
  if (out.size < 3) out.size = 0;
  return out;
}

Polygon cross_section(const std::array<glm::dvec3, 4>& tet, const Plane& plane) {
  std::array<double, 4> height{};
  std::array<unsigned, 4> order{};  // those above the plane first
  unsigned above = 0;
  unsigned below = 4;
  for (unsigned i = 0; i < 4; ++i) {
    height[i] = plane.height(tet[i]);
    if (height[i] > 0) {
      order[above++] = i;
    } else {
      order[--below] = i;
    }
  }
  Polygon out;
  if (above == 0 || above == 4) return out;
  const auto add = [&](unsigned high, unsigned low) {
    const unsigned a = order[high];
    const unsigned b = order[low];
    out.add(crossing(tet[a], height[a], tet[b], height[b]), true);
  };
  if (above == 2) {  // around the quadrilateral, from face to face
    add(0, 2);
    add(0, 3);
    add(1, 3);
    add(1, 2);
  } else {
    const unsigned apex = above == 1 ? 0 : 3;
    for (unsigned i = 0; i < 4; ++i) {
      if (i != apex) add(std::min(i, apex), std::max(i, apex));
    }
  }
  const glm::dvec3 u = out.corners[1] - out.corners[0];
  const glm::dvec3 v = out.corners[2] - out.corners[0];
  if (glm::dot(glm::cross(u, v), plane.normal) < 0) std::swap(out.corners[0], out.corners[2]);
  return out;
}

}  // namespace tetmend::viewer
