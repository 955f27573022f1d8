// SPDX-License-Identifier: MIT
// Random edits on random solids: whatever a guard allows, samples find no violation.
#include "tests/support/random_solids.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "envelope/envelope.h"
#include "tests/envelope/surface_model.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using Segment = std::array<Point, 2>;

/// What the reference was, found without the guard.
struct Before {
  std::vector<Triangle> triangles;
  std::vector<double> tolerance;  // of each
  std::vector<Segment> features;
  std::vector<std::pair<VertexHandle, Point>> corners;
};

std::vector<Segment> features_of(const SurfaceModel& model) {
  std::vector<Segment> result;
  for (const auto& f : model.faces()) {
    for (unsigned k = 0; k < 3; ++k) {
      const VertexHandle a = f[k];
      const VertexHandle b = f[(k + 1) % 3];
      if (a < b && model.guard().is_feature(a, b)) result.push_back({model.at(a), model.at(b)});
    }
  }
  return result;
}

Before look_at(const SurfaceModel& model, const EnvelopeOptions& options) {
  Before before;
  before.triangles = model.triangles();
  for (const Triangle& t : before.triangles) {
    const double edge = ((t[1] - t[0]).norm() + (t[2] - t[1]).norm() + (t[0] - t[2]).norm()) / 3;
    before.tolerance.push_back(options.is_flat()    ? 1e-12
                               : options.length > 0 ? options.length
                                                    : options.share * edge);
  }
  before.features = features_of(model);
  for (const VertexHandle v : model.vertices()) {
    if (model.guard().place(v) == SurfacePlace::corner) before.corners.emplace_back(v, model.at(v));
  }
  return before;
}

double farthest(const std::vector<Segment>& from, const std::vector<Segment>& to) {
  double most = 0;
  for (const Segment& s : from) {
    for (int i = 0; i <= 20; ++i) {
      const Point p = s[0] + (s[1] - s[0]) * i / 20;
      double least = 1e9;
      for (const Segment& other : to) {
        least = std::min(least, segment_distance(p, other[0], other[1]));
      }
      most = std::max(most, least);
    }
  }
  return most;
}

/// Directed sides of triangles without their opposite.
std::size_t open_sides(const SurfaceModel& model) {
  std::map<std::pair<VertexHandle, VertexHandle>, int> sides;
  for (const auto& f : model.faces()) {
    for (unsigned k = 0; k < 3; ++k) {
      ++sides[{f[k], f[(k + 1) % 3]}];
      --sides[{f[(k + 1) % 3], f[k]}];
    }
  }
  return static_cast<std::size_t>(
      std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second != 0; }));
}

/// What is wrong; empty if nothing.
std::string sample_complaint(const SurfaceModel& model, const Before& before,
                             const EnvelopeOptions& options) {
  const std::vector<Triangle> now = model.triangles();
  const double most = *std::max_element(before.tolerance.begin(), before.tolerance.end());
  if (sampled_distance(now, before.triangles) > most) return "too far from the reference";
  const TriangleGrid grid(now);
  for (std::size_t i = 0; i < before.triangles.size(); ++i) {
    const Triangle& t = before.triangles[i];
    for (int a = 0; a <= 13; ++a) {
      for (int b = 0; a + b <= 13; ++b) {
        const Point p = t[0] + (t[1] - t[0]) * a / 13 + (t[2] - t[0]) * b / 13;
        if (grid.distance(p) > before.tolerance[i]) return "a part of the reference is lost";
      }
    }
  }
  const std::vector<Segment> features = features_of(model);
  if (farthest(features, before.features) > most) return "a feature strayed";
  if (farthest(before.features, features) > most) return "a feature was lost";
  for (const auto& [v, p] : before.corners) {
    if (model.at(v) != p || model.guard().place(v) != SurfacePlace::corner) return "a corner moved";
    if (model.star(v).empty()) return "a corner is gone";
  }
  const double area = total_area(before.triangles);
  if (std::abs(enclosed_volume(now) - enclosed_volume(before.triangles)) > most * area) {
    return "the volume changed";
  }
  if (options.is_flat() && std::abs(total_area(now) - area) > 1e-12 * area)
    return "the area changed";
  return {};
}

}  // namespace

TEST_CASE("random solids: samples find no violation of what the guard promises") {
  const char* wanted = std::getenv("TETMEND_SOLIDS");
  const int solids = wanted == nullptr ? 40 : std::atoi(wanted);
  RandomSolids source(2024);
  contract::Random random(7);
  std::size_t made = 0;
  for (int i = 0; i < solids; ++i) {
    const Solid solid = source.next();
    EnvelopeOptions options;
    options.angle = random.index(2) == 0 ? 40 : 60;
    switch (random.index(4)) {
      case 0:
        break;
      case 1:
        options.length = random.real(0.0005, 0.03);
        break;
      default:
        options.share = random.real(0.003, 0.1);
    }
    SurfaceModel model(TetMesh(solid.data), options);
    const Before before = look_at(model, options);
    const std::size_t open = open_sides(model);
    for (int edit = 0; edit < 150; ++edit)
      made += model.random_edit(random, random.real(0.02, 0.5));
    CAPTURE(i);
    CAPTURE(solid.name);
    CAPTURE(options.share);
    CAPTURE(options.length);
    CHECK(sample_complaint(model, before, options) == "");
    CHECK((open_sides(model) > 0) == (open > 0));  // around an interface their number may change
    const SurfaceBound bound = model.guard().proven_bound();
    CHECK(bound.share <= 1);
    CHECK(bound.distance >= sampled_distance(model.triangles(), before.triangles, 5) - 1e-15);
  }
  CHECK(made > 40 * static_cast<std::size_t>(solids));
}
