// SPDX-License-Identifier: MIT
#include "viewer/debugger/flat_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "viewer/debugger/call_highlight.h"
#include "viewer/mesh/tet_values.h"
#include "viewer/mesh/visibility.h"

namespace tetmend::viewer {

namespace {

constexpr double kRadius = 0.76;  // of the polygon
constexpr double kNames = 0.9;    // of the circle on which the names of its corners are

glm::dvec2 in_plane(const Eigen::Vector2d& place) {
  return {place.x(), place.y()};
}

Colour colour_of(Quality quality, const ColourMap& map) {
  if (quality < kBadThreshold) return kBadColour;
  return map.at(static_cast<double>(quality) / tet_values().front().range.high);
}

std::string number(double quality) {
  return fmt::format("{:.3f}", quality);
}

class PolygonDrawer {
 public:
  PolygonDrawer(const CallStudy& study, const ColourMap& map)
      : shell_(*study.picture), map_(map), size_(shell_.ring.size()) {}

  void outline() {
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t j = (i + 1) % size_;
      drawing_.strokes.push_back({place(i), place(j), kSkirtColour, 3, false, {}, ends(i, j)});
      drawing_.labels.push_back({kNames * in_plane(shell_.place(i)),
                                 fmt::format("{}", shell_.ring[i].index()),
                                 true,
                                 {shell_.ring[i]}});
    }
  }

  /// Chords whose pockets the search may use, as far as quality goes.
  void chords() {
    const std::vector<Chord> chords = chords_of(shell_);
    for (auto chord = chords.rbegin(); chord != chords.rend(); ++chord) {  // the best on top
      const bool usable = chord->best()[0] > shell_.floor;
      const std::string tip =
          fmt::format("chord {} - {}: worst quality of its pockets {:.4f} and {:.4f}{}",
                      shell_.ring[chord->from].index(), shell_.ring[chord->to].index(),
                      chord->on[0], chord->back[0], usable ? "" : "; not better than the old tets");
      drawing_.strokes.push_back({place(chord->from), place(chord->to),
                                  faint(kChordColour, usable ? 0.9 : 0.35), 1.5, !usable, tip,
                                  ends(chord->from, chord->to)});
    }
  }

  void covering(const FlatCovering& covering, bool dashed) {
    if (covering.core.size() >= 3) core(covering);
    for (const FlatCovering::Triangle& t : covering.triangles) triangle(t, dashed);
    for (const FlatCovering::Side& side : covering.core) {
      if (covering.triangles.empty()) continue;
      drawing_.strokes.push_back(
          {place(side.from), place(side.to), kCoreColour, 4, dashed,
           fmt::format("side of the core {} - {}: {:.4f}", shell_.ring[side.from].index(),
                       shell_.ring[side.to].index(), side.quality),
           ends(side.from, side.to)});
    }
  }

  FlatDrawing take(std::string caption) {
    drawing_.caption = std::move(caption);
    return std::move(drawing_);
  }

 private:
  std::vector<VertexHandle> ends(std::size_t i, std::size_t j) const {
    return {shell_.ring[i], shell_.ring[j]};
  }
  glm::dvec2 place(std::size_t i) const { return kRadius * in_plane(shell_.place(i)); }

  /// Each side of the core with the edge ab, a tet, is a slice from its middle.
  void core(const FlatCovering& covering) {
    glm::dvec2 middle{0};
    for (const auto& side : covering.core) middle += place(side.from);
    middle /= static_cast<double>(covering.core.size());
    for (const auto& side : covering.core) {
      std::vector<VertexHandle> tet = ends(side.from, side.to);
      tet.insert(tet.end(), {shell_.a, shell_.b});
      drawing_.areas.push_back({{middle, place(side.from), place(side.to)},
                                faint(colour_of(side.quality, map_), 0.75),
                                std::move(tet)});
      drawing_.strokes.push_back({middle,
                                  place(side.from),
                                  faint(kSupportingEdgeColour, 0.6),
                                  1,
                                  false,
                                  {},
                                  {shell_.a, shell_.b, shell_.ring[side.from]}});
      const glm::dvec2 on_side = (place(side.from) + place(side.to)) / 2.0;
      drawing_.labels.push_back({0.3 * middle + 0.7 * on_side, number(side.quality), false, {}});
    }
    drawing_.labels.push_back({middle, "ab", true, {shell_.a, shell_.b}});
  }

  void triangle(const FlatCovering::Triangle& t, bool dashed) {
    const std::array<glm::dvec2, 3> c = {place(t.corners[0]), place(t.corners[1]),
                                         place(t.corners[2])};
    const double opacity = dashed ? 0.35 : 0.75;
    drawing_.areas.push_back(
        {{c[0], c[1], c[2]},
         faint(colour_of(t.quality, map_), opacity),
         {shell_.ring[t.corners[0]], shell_.ring[t.corners[1]], shell_.ring[t.corners[2]]}});
    for (unsigned i = 0; i < 3; ++i) {
      drawing_.strokes.push_back({c[i],
                                  c[(i + 1) % 3],
                                  kChordColour,
                                  2,
                                  dashed,
                                  {},
                                  ends(t.corners[i], t.corners[(i + 1) % 3])});
    }
    drawing_.labels.push_back({(c[0] + c[1] + c[2]) / 3.0, number(t.quality), false, {}});
  }

  const ShellPicture& shell_;
  const ColourMap& map_;
  std::size_t size_;
  FlatDrawing drawing_;
};

}  // namespace

FlatDrawing draw_polygon(const CallStudy& study, std::uint64_t position, bool refused,
                         const ColourMap& map) {
  PolygonDrawer drawer(study, map);
  const ShellPicture& shell = *study.picture;
  const PolygonStage stage = stage_of(study, position, refused);
  drawer.outline();
  switch (stage) {
    case PolygonStage::made:
      drawer.covering(*study.covering, false);
      break;
    case PolygonStage::best_triangulation:
      drawer.chords();
      drawer.covering(shell.full, true);
      break;
    case PolygonStage::before:
      drawer.covering(shell.before, false);
      drawer.chords();
      break;
  }
  return drawer.take(caption_of(study, stage));
}

FlatDrawing draw_tets(std::span<const LocalTet> tets, const Camera& camera, const Ball& ball,
                      const ColourMap& map, double opacity) {
  constexpr double kShrink = 0.12;
  constexpr double kDarkest = 0.62;
  const glm::dvec3 right = camera.right();
  const glm::dvec3 up = camera.up();
  const glm::dvec3 forward = camera.forward();
  std::vector<std::pair<double, FlatDrawing::Area>> areas;  // by depth
  for (const LocalTet& tet : tets) {
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
      const Colour full = colour_of(tet.quality, map);
      const double light = kDarkest + (1 - kDarkest) * towards;
      const auto dim = [&](std::uint8_t x) { return static_cast<std::uint8_t>(light * x); };
      FlatDrawing::Area area{{},
                             faint({dim(full.red), dim(full.green), dim(full.blue)}, opacity),
                             {tet.vertices.begin(), tet.vertices.end()}};
      for (const glm::dvec3& p : c) {
        area.corners.emplace_back(glm::dot(p, right) / ball.radius, glm::dot(p, up) / ball.radius);
      }
      areas.emplace_back(glm::dot((c[0] + c[1] + c[2]) / 3.0, forward), std::move(area));
    }
  }
  std::stable_sort(areas.begin(), areas.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  FlatDrawing drawing;
  for (auto& entry : areas) drawing.areas.push_back(std::move(entry.second));
  return drawing;
}

std::optional<Ball> ball_around(const CallStudy& study) {
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high = -low;
  for (const auto* tets : {&study.before, &study.after}) {
    for (const LocalTet& tet : *tets) {
      for (const Point& corner : tet.corners) {
        low = glm::min(low, to_glm(corner));
        high = glm::max(high, to_glm(corner));
      }
    }
  }
  if (study.before.empty() && study.after.empty()) return std::nullopt;
  return Ball{(low + high) / 2.0, std::max(glm::distance(low, high) / 2, 1e-12)};
}

}  // namespace tetmend::viewer
