// SPDX-License-Identifier: MIT
// The pass that keeps the best of many variants of a neighbourhood.
#include "schedule/vary.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "contract/zoo.h"
#include "kernel/integrity.h"
#include "kernel/star.h"
#include "kernel/surface_fingerprint.h"
#include "kernel/workspace.h"
#include "schedule/neighbourhood.h"
#include "tests/support/registry.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::contract;
using namespace tetmend::test;

namespace {

std::vector<Quality> qualities(const TetMesh& mesh) {
  std::vector<Quality> all;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (!mesh.is_deleted(TetHandle(i))) all.push_back(mesh.quality(TetHandle(i)));
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::size_t bad(const std::vector<Quality>& all) {
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](Quality q) { return q < kBadThreshold; }));
}

MeshData varied(unsigned threads) {
  TetMesh mesh(delaunay_ball(400, 3));
  Run run(mesh, kRegistry);
  tbb::task_arena(static_cast<int>(threads)).execute([&] {
    vary(run, {.on = {.worst = 6}, .rings = 3, .variants = 4});
  });
  return mesh.to_data();
}

}  // namespace

TEST_CASE("the best of many variants is better than what was there, and the surface stays") {
  TetMesh mesh(delaunay_ball(400, 3));
  const std::vector<Quality> before = qualities(mesh);
  const std::uint64_t surface = surface_fingerprint(mesh);
  const double volume = test::total_volume(mesh);
  Run run(mesh, kRegistry);
  vary(run, {.on = {.worst = 6}, .rings = 3, .variants = 4});
  CHECK(run.records.back().accepted() > 0);
  CHECK(bad(qualities(mesh)) < bad(before));
  CHECK(improves(qualities(mesh), before));
  CHECK(surface_fingerprint(mesh) == surface);
  CHECK(test::total_volume(mesh) == doctest::Approx(volume).epsilon(1e-12));
  CHECK(check_integrity(mesh).empty());
}

TEST_CASE("a worst tet pays for half of the bad ones where it may, but not beyond the limits") {
  TetMesh improved(delaunay_ball(400, 5));
  Run first(improved, kRegistry);
  improve(first, Schedule::builtin("shell"), {{"polish_first", "0"}, {"polish_last", "0"}});
  const MeshData data = improved.to_data();
  const auto varied = [&](double floor, bool holds) {
    TetMesh mesh(data);
    Run run(mesh, kRegistry);
    run.set_standard(Standard({34, 146}, Standard::Terms::sine, 0));
    const std::size_t tets = mesh.tet_count();
    if (holds) run.set_most_tets(tets);
    const std::vector<Quality> before = qualities(mesh);
    vary(run, {.on = {.worst = 8}, .rings = 2, .variants = 8, .first = 30, .floor = floor});
    CHECK(bad(qualities(mesh)) <= bad(before));
    CHECK(check_integrity(mesh).empty());
    if (holds) CHECK(mesh.tet_count() <= tets);
    return std::pair(qualities(mesh), before.front());
  };
  const auto [strict, worst] = varied(1, false);
  const auto [paid, same] = varied(0.3, false);
  varied(0.3, true);
  CHECK(strict.front() >= worst);
  CHECK(bad(paid) < bad(strict));
  CHECK(paid.front() < worst);
  CHECK(paid.front() >= 0.3f * worst);
}

TEST_CASE("variants are the same for any number of threads") {
  const MeshData alone = varied(1);
  const MeshData by_three = varied(3);
  CHECK(alone.points == by_three.points);
  CHECK(alone.tets == by_three.tets);
}

TEST_CASE("frozen tets, constraints and the border of regions stay in all variants") {
  MeshData data = kuhn_cube(6, 0.35, 2);
  for (std::size_t i = 0; i < data.tets.size(); ++i) {
    const auto& v = data.tets[i].vertices;
    data.tets[i].label = data.points[v[0]].x() + data.points[v[1]].x() < 1 ? 1 : 2;
  }
  TetMesh mesh(data);
  mesh.freeze([&](TetHandle t) { return mesh.point(mesh.vertices(t)[0]).y() < 0.3; });
  std::vector<TetVertices> frozen;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (mesh.is_frozen(TetHandle(i))) frozen.push_back(mesh.vertices(TetHandle(i)));
  }
  REQUIRE(frozen.size() > 50);
  const std::uint64_t surface = surface_fingerprint(mesh);
  Run run(mesh, kRegistry);
  vary(run, {.on = {.worst = 10}, .rings = 3, .variants = 3});
  CHECK(run.records.back().accepted() > 0);
  CHECK(surface_fingerprint(mesh) == surface);
  CHECK(check_integrity(mesh).empty());
  std::vector<TetVertices> now;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (!mesh.is_deleted(TetHandle(i)) && mesh.is_frozen(TetHandle(i))) {
      now.push_back(mesh.vertices(TetHandle(i)));
    }
  }
  CHECK(now == frozen);
}

TEST_CASE("no tet is in two neighbourhoods, and their border has no vertex that may move") {
  TetMesh mesh(delaunay_ball(400, 3));
  NeighbourhoodMarks marks;
  Workspace workspace(mesh);
  std::set<std::uint32_t> seen;
  for (std::uint32_t number = 1; number <= 4; ++number) {
    const auto free = std::find(marks.begin(), marks.end(), 0u);
    const TetHandle middle(marks.empty() ? 0u : static_cast<std::uint32_t>(free - marks.begin()));
    const Neighbourhood found = find_neighbourhood(mesh, workspace, middle, 1, 1000, number, marks);
    REQUIRE(!found.tets.empty());
    for (const TetHandle t : found.tets) CHECK(seen.insert(t.index()).second);
    for (std::size_t i = 0; i < found.vertices.size(); ++i) {
      if (found.stays[i]) continue;
      for (const TetHandle t : star(mesh, found.vertices[i])) {
        CHECK(marks[t.index()] == number);
      }
    }
  }
}
