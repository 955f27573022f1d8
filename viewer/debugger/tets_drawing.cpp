// SPDX-License-Identifier: MIT
#include "viewer/debugger/tets_drawing.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "explain/figures/figure_parts.h"
#include "viewer/mesh/visibility.h"

namespace tetmend::viewer {

LinkedDrawing draw_tets(std::span<const LocalTet> tets, const Camera& camera, const Ball& ball,
                        const Square& square, const ColourMap& map, double opacity) {
  constexpr double kShrink = 0.12;
  constexpr double kDarkest = 0.62;
  const glm::dvec3 right = camera.right();
  const glm::dvec3 up = camera.up();
  const glm::dvec3 forward = camera.forward();
  struct Side {
    double depth;
    figure::Area area;
    const LocalTet* tet;
  };
  std::vector<Side> sides;
  for (const LocalTet& tet : tets) {
    const Colour full = tet_colour(tet.quality, map);
    const glm::dvec3 centre =
        to_glm((tet.corners[0] + tet.corners[1] + tet.corners[2] + tet.corners[3]) / 4);
    for (const auto& face : kFaceVertices) {
      std::array<glm::dvec3, 3> c;
      for (unsigned i = 0; i < 3; ++i) {
        c[i] = glm::mix(to_glm(tet.corners[face[i]]), centre, kShrink) - ball.centre;
      }
      const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
      const double towards = -glm::dot(normal, forward) / std::max(glm::length(normal), 1e-300);
      if (towards <= 0) continue;
      const double light = kDarkest + (1 - kDarkest) * towards;
      const auto dim = [&](std::uint8_t x) { return static_cast<std::uint8_t>(light * x); };
      figure::Area area{{}, faint({dim(full.red), dim(full.green), dim(full.blue)}, opacity), {}};
      const double size = square.half / ball.radius;
      for (const glm::dvec3& p : c) {
        area.corners.push_back({square.middle.x + size * glm::dot(p, right),
                                square.middle.y - size * glm::dot(p, up)});
      }
      sides.push_back({glm::dot((c[0] + c[1] + c[2]) / 3.0, forward), std::move(area), &tet});
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& x, const Side& y) { return x.depth > y.depth; });
  LinkedDrawing drawing;
  for (Side& side : sides) {
    const auto& v = side.tet->vertices;
    drawing.add(std::move(side.area), {{v.begin(), v.end()}, {}});
  }
  return drawing;
}

std::optional<Ball> ball_around(std::span<const LocalTet> tets) {
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high = -low;
  for (const LocalTet& tet : tets) {
    for (const Point& corner : tet.corners) {
      low = glm::min(low, to_glm(corner));
      high = glm::max(high, to_glm(corner));
    }
  }
  if (tets.empty()) return std::nullopt;
  return Ball{(low + high) / 2.0, std::max(glm::distance(low, high) / 2, 1e-12)};
}

std::optional<Ball> ball_around(const CallStudy& study) {
  std::vector<LocalTet> both = study.before;
  both.insert(both.end(), study.after.begin(), study.after.end());
  return ball_around(both);
}

}  // namespace tetmend::viewer
