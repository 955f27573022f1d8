// SPDX-License-Identifier: MIT
// Whole runs on random solids whose surface may move: samples that share no code with the proof find
// no violation.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tetmend/improve.h>

#include "contract/zoo.h"
#include "face/mesh_access.h"
#include "tests/support/random_solids.h"
#include "tests/support/surface_promise.h"

using namespace tetmend;
using namespace tetmend::test;

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
    const Surfaces before = surfaces_of(solid.data);
    const Result result = improve(mesh, {.surface = surface});
    CHECK(complaint(before, surfaces_of(MeshAccess::data(mesh)), surface) == "");
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

TEST_CASE("a ball whose surface moves keeps its volume to an eighth of what the tolerance allows") {
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
          change.tolerance * region.area_before / 8);
    touched += change.touched;
  }
  CHECK(touched > 40);
}
