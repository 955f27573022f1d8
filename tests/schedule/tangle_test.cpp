// SPDX-License-Identifier: MIT
#include "schedule/tangle.h"

#include <algorithm>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/star.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const std::function<bool()> kNoStop = [] { return true; };

std::size_t count_inverted(const TetMesh& mesh, const std::vector<TetHandle>& tets) {
  return static_cast<std::size_t>(
      std::count_if(tets.begin(), tets.end(), [&](TetHandle t) { return mesh.quality(t) <= 0; }));
}

/// A cube of 16^3 cells in which the inner vertices of two places are moved at random.
MeshData two_knots() {
  MeshData data = kuhn_cube(16, 0, 1);
  Random random(1);
  for (Point& p : data.points) {
    const bool first = (p - Point(0.25, 0.25, 0.25)).cwiseAbs().maxCoeff() < 0.1;
    const bool second = (p - Point(0.75, 0.75, 0.75)).cwiseAbs().maxCoeff() < 0.1;
    if (first || second) p += random.in_ball(0.3);
  }
  return data;
}

std::vector<Tangle> find(const TetMesh& mesh, const TangleLimits& limits) {
  return find_tangles(mesh, limits, kNoStop);
}

}  // namespace

TEST_CASE("a tangled cube is one tangle of all free vertices and the tets around them") {
  const TetMesh mesh(kuhn_cube(6, 1.5, 1));
  const auto tangles = find(mesh, {});
  REQUIRE(tangles.size() == 1);
  std::size_t free = 0;
  for (const VertexHandle v : live_vertices(mesh)) free += mesh.is_fixed(v) ? 0 : 1;
  CHECK(tangles[0].free.size() == free);
  const std::set<VertexHandle> distinct(tangles[0].free.begin(), tangles[0].free.end());
  CHECK(distinct.size() == free);
  CHECK(std::none_of(distinct.begin(), distinct.end(),
                     [&](VertexHandle v) { return mesh.is_fixed(v); }));
  for (const TetHandle t : live_tets(mesh)) {
    const TetVertices& v = mesh.vertices(t);
    const bool has_free =
        std::any_of(v.begin(), v.end(), [&](VertexHandle w) { return !mesh.is_fixed(w); });
    CHECK(std::count(tangles[0].tets.begin(), tangles[0].tets.end(), t) == (has_free ? 1 : 0));
    CHECK(mesh.quality(t) >= mesh.quality(tangles[0].worst));
  }
}

TEST_CASE("a sound mesh has no tangle, and one with few inverted tets none either") {
  CHECK(find(TetMesh(kuhn_cube(6, 0.2, 1)), {.share = 0, .at_least = 1}).empty());
  const TetMesh ball(tangled_ball(200, 1));
  REQUIRE(count_inverted(ball, live_tets(ball)) > 0);
  CHECK(find(ball, {}).empty());
  CHECK(find(ball, {.share = 0, .at_least = 1}).size() == 1);
}

TEST_CASE("two places of many inverted tets are two tangles, which rings may join") {
  const TetMesh mesh(two_knots());
  for (const unsigned rings : {0u, 1u}) {
    CAPTURE(rings);
    const auto tangles = find(mesh, {.rings = rings});
    REQUIRE(tangles.size() == 2);
    CHECK(count_inverted(mesh, tangles[0].tets) > 100);
    CHECK(count_inverted(mesh, tangles[1].tets) > 100);
    std::set<TetHandle> tets(tangles[0].tets.begin(), tangles[0].tets.end());
    tets.insert(tangles[1].tets.begin(), tangles[1].tets.end());
    CHECK(tets.size() == tangles[0].tets.size() + tangles[1].tets.size());
  }
  const auto small = find(mesh, {.rings = 0});
  const auto large = find(mesh, {.rings = 1});
  CHECK(large[0].free.size() > small[0].free.size());
  CHECK(find(mesh, {.rings = 10}).size() == 1);
}

TEST_CASE("a place of too few inverted tets, or of too small a share, is no tangle") {
  const TetMesh mesh(two_knots());
  const auto tangles = find(mesh, {.rings = 0});
  REQUIRE(tangles.size() == 2);
  std::size_t fewest = 1000000;
  std::size_t most = 0;
  double largest = 0;
  for (const Tangle& tangle : tangles) {
    const std::size_t count = count_inverted(mesh, tangle.tets);
    fewest = std::min(fewest, count);
    most = std::max(most, count);
    largest =
        std::max(largest, static_cast<double>(count) / static_cast<double>(tangle.tets.size()));
  }
  CHECK(find(mesh, {.at_least = fewest, .rings = 0}).size() == 2);
  CHECK(find(mesh, {.at_least = fewest + 1, .rings = 0}).size() == (fewest == most ? 0 : 1));
  CHECK(find(mesh, {.at_least = most + 1}).empty());
  CHECK(find(mesh, {.share = largest + 0.01}).empty());
}

TEST_CASE("frozen tets make no tangle, and their vertices do not move") {
  TetMesh mesh(two_knots());
  mesh.freeze([&](TetHandle t) { return mesh.point(mesh.vertices(t)[0]).x() < 0.5; });
  const auto tangles = find(mesh, {});
  REQUIRE(tangles.size() == 1);
  for (const VertexHandle v : tangles[0].free) CHECK_FALSE(mesh.is_frozen(v));
}

TEST_CASE("a search that is stopped finds nothing") {
  const TetMesh mesh(kuhn_cube(8, 1.5, 1));
  CHECK(find_tangles(mesh, {}, [] { return false; }).empty());
}
