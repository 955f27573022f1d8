// SPDX-License-Identifier: MIT
// Whole runs on random solids whose surface may move: samples that share no code with the proof find
// no violation.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <tetmend/improve.h>

#include "contract/zoo.h"
#include "face/mesh_access.h"
#include "kernel/tet_faces.h"
#include "tests/support/random_solids.h"
#include "tests/support/surface_distance.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// By the labels of both sides, the smaller first; outside is the smallest number.
using Surfaces = std::map<std::pair<Label, Label>, std::vector<Triangle>>;

Surfaces surfaces(const MeshData& data) {
  constexpr Label kOutside = std::numeric_limits<Label>::min();
  Surfaces all;
  for_face_pairs(sorted_tet_faces(data), [&](const TetFace& face, const TetFace* other) {
    const Label here = data.tets[face.tet].label;
    const Label there = other == nullptr ? kOutside : data.tets[other->tet].label;
    if (here == there) return;
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = data.points[face.vertices[k]];
    all[std::minmax(here, there)].push_back(t);
  });
  return all;
}

double mean_edge(const Triangle& t) {
  return ((t[1] - t[0]).norm() + (t[2] - t[1]).norm() + (t[0] - t[2]).norm()) / 3;
}

/// What a run with this surface may do at most, of each triangle.
double tolerance_of(const std::string& surface, const Triangle& t) {
  if (surface == "flat") return 1e-11;  // solids are some units large
  const double value = std::atof(surface.c_str());
  return surface.back() == '%' ? value / 100 * mean_edge(t) : value;
}

/// What is wrong; empty if nothing.
std::string complaint(const Surfaces& before, const Surfaces& now, const std::string& surface) {
  if (before.size() != now.size()) return "a surface between two labels came or went";
  for (const auto& [sides, was] : before) {
    if (!now.contains(sides)) return "a surface between two labels is gone";
    const std::vector<Triangle>& is = now.at(sides);
    double most = 0;
    const TriangleGrid grid(is);
    for (const Triangle& t : was) {
      const double tolerance = tolerance_of(surface, t);
      most = std::max(most, tolerance);
      for (int a = 0; a <= 13; ++a) {
        for (int b = 0; a + b <= 13; ++b) {
          const Point p = t[0] + (t[1] - t[0]) * a / 13 + (t[2] - t[0]) * b / 13;
          if (grid.distance(p) > tolerance) return "a part of the old surface is lost";
        }
      }
    }
    if (sampled_distance(is, was) > most) return "the new surface is too far away";
  }
  return {};
}

}  // namespace

TEST_CASE("random solids: whole runs keep the surface within the tolerance, both ways") {
  const char* wanted = std::getenv("TETMEND_SOLIDS");
  const int solids = wanted == nullptr ? 8 : std::atoi(wanted);
  const std::vector<std::string> choices = {"flat", "1%", "3%", "10%", "0.01"};
  RandomSolids source(99, 0.33);
  std::size_t touched = 0;
  for (int i = 0; i < solids; ++i) {
    const Solid solid = source.next();
    const std::string& surface = choices[static_cast<std::size_t>(i) % choices.size()];
    CAPTURE(i);
    CAPTURE(solid.name);
    CAPTURE(surface);
    Mesh mesh = MeshAccess::make(solid.data);
    const Surfaces before = surfaces(solid.data);
    const Result result = improve(mesh, {.surface = surface});
    CHECK(complaint(before, surfaces(MeshAccess::data(mesh)), surface) == "");
    REQUIRE(result.surface_change);
    const SurfaceChange& change = *result.surface_change;
    CHECK(change.sampled <= change.proven);
    CHECK(change.proven <= std::max(change.tolerance, 1e-11));
    touched += change.touched;
    double area = 0;
    double volume_change = 0;
    for (const SurfaceChange::Region& region : change.regions) {
      area += region.area_before;
      volume_change += std::abs(region.volume_after - region.volume_before);
    }
    CHECK(volume_change <= std::max(change.tolerance, 1e-11) * area);
  }
  CHECK(touched > 10 * static_cast<std::size_t>(solids));
}

TEST_CASE("a ball whose surface moves keeps its volume to a tenth of what the tolerance allows") {
  std::size_t touched = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    CAPTURE(seed);
    Mesh mesh = MeshAccess::make(contract::delaunay_ball(2000, seed));
    const Result result =
        improve(mesh, {.goal = Goal{40, 140}, .surface = "5%", .feature_angle = 170});
    REQUIRE(result.surface_change);
    const SurfaceChange& change = *result.surface_change;
    REQUIRE(change.regions.size() == 1);
    const SurfaceChange::Region& region = change.regions[0];
    CHECK(std::abs(region.volume_after - region.volume_before) <
          change.tolerance * region.area_before / 10);
    touched += change.touched;
  }
  CHECK(touched > 40);
}
