// SPDX-License-Identifier: MIT
// The pass that makes edges as long as wanted.
#include "schedule/adapt.h"

#include <memory>
#include <random>
#include <set>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "contract/zoo.h"
#include "kernel/error.h"
#include "kernel/integrity.h"
#include "kernel/surface_fingerprint.h"
#include "kernel/wanted_lengths.h"
#include "schedule/passes.h"
#include "schedule/schedule.h"
#include "tests/support/registry.h"

using namespace tetmend;
using namespace tetmend::contract;
using namespace tetmend::test;

namespace {

struct Share {
  std::size_t edges = 0;
  std::size_t in_range = 0;
  double longest = 0;
  double of_range() const { return static_cast<double>(in_range) / static_cast<double>(edges); }
};

/// Of the edges with an end inside, each counted once for each of its tets.
Share inside(const TetMesh& mesh, const WantedLengths& wanted) {
  Share share;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (mesh.is_deleted(TetHandle(i))) continue;
    const TetVertices& v = mesh.vertices(TetHandle(i));
    for (const auto& [j, k] : kEdgeVertices) {
      if (mesh.is_fixed(v[j]) && mesh.is_fixed(v[k])) continue;
      const double length = wanted.relative_length(mesh.point(v[j]), mesh.point(v[k]));
      ++share.edges;
      share.in_range += WantedLengths::fit(length) >= 1 ? 1 : 0;
      share.longest = std::max(share.longest, length);
    }
  }
  return share;
}

std::shared_ptr<const WantedLengths> grading(double at_zero, double per_x) {
  return std::make_shared<WantedLengths>([=](const Point& p) { return at_zero + per_x * p.x(); });
}

}  // namespace

TEST_CASE("without wanted lengths there is nothing to adapt to") {
  TetMesh mesh(kuhn_cube(3, 0, 1));
  Run run(mesh, kRegistry);
  CHECK_THROWS_AS(adapt(run), Error);
}

TEST_CASE("splits and contractions bring edges into the wanted range, and the surface stays") {
  for (const double wanted_length : {0.08, 0.16}) {
    CAPTURE(wanted_length);
    TetMesh mesh(kuhn_cube(wanted_length < 0.1 ? 5 : 12, 0.1, 1));
    const auto wanted = std::make_shared<WantedLengths>(wanted_length);
    mesh.set_size_field(wanted);
    const std::uint64_t surface = surface_fingerprint(mesh);
    const std::size_t tets = mesh.tet_count();
    const Share before = inside(mesh, *wanted);
    Run run(mesh, kRegistry);
    adapt(run, {.sweeps = 20});
    const Share after = inside(mesh, *wanted);
    CHECK(after.of_range() > before.of_range() + 0.1);
    CHECK((wanted_length < 0.1 ? mesh.tet_count() > 4 * tets : mesh.tet_count() < tets));
    CHECK(surface_fingerprint(mesh) == surface);
    CHECK(check_integrity(mesh).empty());
  }
}

TEST_CASE("no pass under wanted lengths undoes what splits and contractions have reached") {
  TetMesh mesh(kuhn_cube(6, 0.1, 1));
  const auto wanted = grading(0.06, 0.1);
  mesh.set_size_field(wanted);
  Run run(mesh, kRegistry);
  adapt(run, {.sweeps = 10});
  const Share then = inside(mesh, *wanted);
  for (const auto& pass : {+[](Run& r) { polish(r); }, +[](Run& r) { insert_points(r); },
                           +[](Run& r) { suppress_points(r); }, +[](Run& r) { smooth(r); }}) {
    pass(run);
    const Share now = inside(mesh, *wanted);
    CHECK(now.edges - now.in_range <= then.edges);
    CHECK(now.longest <= then.longest * (1 + 1e-6));
  }
}

TEST_CASE("the schedule of sizes makes edges as long as wanted where tets were inverted, too") {
  MeshData data = kuhn_cube(6, 0, 1);
  std::mt19937 chance(7);
  const auto shift = [&] { return 0.3 * (static_cast<double>(chance()) / 4294967295.0 - 0.5); };
  for (Point& p : data.points) {
    const bool is_inner = p.minCoeff() > 0.01 && p.maxCoeff() < 0.99;
    for (double& x : p) x += is_inner ? shift() : 0;
  }
  TetMesh mesh(data);
  const auto wanted = std::make_shared<WantedLengths>(0.1);
  mesh.set_size_field(wanted);
  const auto inverted = [&] {
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      const TetHandle t(i);
      count += !mesh.is_deleted(t) && !(mesh.quality(t) > 0) ? 1 : 0;
    }
    return count;
  };
  CHECK(inverted() > mesh.tet_count() / 10);
  Run run(mesh, kRegistry);
  improve(run, Schedule::builtin("adapt"));
  CHECK(inverted() == 0);
  CHECK(inside(mesh, *wanted).of_range() > 0.9);
  CHECK(check_integrity(mesh).empty());
}

TEST_CASE("the schedule of sizes does the same on one thread and on three") {
  std::vector<std::vector<Point>> results;
  for (const int threads : {1, 3}) {
    tbb::task_arena arena(threads);
    arena.execute([&] {
      TetMesh mesh(kuhn_cube(10, 0.1, 1));
      mesh.set_size_field(grading(0.022, 0.08));
      Run run(mesh, kRegistry);
      improve(run, Schedule::builtin("adapt"));
      const MeshData data = std::move(mesh).to_data();
      results.push_back(data.points);
    });
  }
  CHECK(results[0].size() > 12000);  // more than one block
  CHECK(results[0] == results[1]);
}
