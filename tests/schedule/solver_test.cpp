// SPDX-License-Identifier: MIT
// What the default promises the solver that follows: the step, the largest angle, the mean.
#include <cmath>
#include <string>
#include <tuple>

#include <doctest/doctest.h>

#include "kernel/bounds.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/integrity.h"
#include "kernel/solver_rulers.h"
#include "kernel/statistics.h"
#include "ops/registry.h"
#include "schedule/passes.h"
#include "schedule/schedule.h"
#include "tests/support/renumbered.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const Registry kSolverRegistry = Registry::builtin();

struct Ended {
  double step = 0;
  double theta_max = 0;
  double mean = 0;
  std::size_t tets = 0;
};

Ended figures(const TetMesh& mesh) {
  return {stable_step(mesh), compute_statistics(mesh).theta_max,
          summarize(mesh, find_quality_measure("mean_ratio")).mean, mesh.tet_count()};
}

Ended default_run(TetMesh& mesh, Bounds::Holding holding) {
  mesh.set_bounds(Bounds::of(mesh, holding));
  Run run(mesh, kSolverRegistry);
  improve(run, Schedule::builtin("shell"));
  CHECK(to_string(check_integrity(mesh)) == "");
  return figures(mesh);
}

}  // namespace

TEST_CASE("the stable step never falls where it is held, and falls where it is not") {
  bool has_fallen = false;
  for (const std::uint64_t seed : {1U, 2U}) {
    CAPTURE(seed);
    const MeshData data = renumbered(
        read_mesh(std::string(TETMEND_SOURCE_DIR) + "/assets/meshes/folded_sheet.mesh"), seed);
    TetMesh held(data);
    TetMesh free(data);
    const double before = stable_step(held);
    REQUIRE(before > 0);
    CHECK(default_run(held, Bounds::Holding::solver).step >= before * (1 - 1e-9));
    has_fallen =
        has_fallen || default_run(free, Bounds::Holding::angles).step < before * (1 - 1e-9);
  }
  CHECK(has_fallen);
}

TEST_CASE("the step at a vertex from its star is that from the sums over all tets") {
  const TetMesh mesh(delaunay_ball(200, 9));
  const P1Diagonals sums = p1_diagonals(mesh);
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (mesh.is_deleted(v) || !mesh.tet_of(v).is_valid()) continue;
    const auto at = squared_step_at(mesh, v);
    REQUIRE(at.has_value());
    CHECK(*at == doctest::Approx(sums.mass[i] / sums.stiffness[i]).epsilon(1e-12));
  }
}

TEST_CASE("where no angle misses the goal, none becomes larger than the largest") {
  bool has_grown = false;
  for (const unsigned seed : {1U, 2U, 3U}) {
    CAPTURE(seed);
    const auto growth = [&](Bounds::Holding holding) {
      TetMesh mesh(kuhn_cube(5, 0.2, seed));
      const double before = compute_statistics(mesh).theta_max;
      REQUIRE(before < 140);
      Run run(mesh, kSolverRegistry);
      run.set_standard(Standard(Goal{.min_angle = 35, .max_angle = 150}));
      mesh.set_bounds(Bounds::of(mesh, holding));
      improve(run, Schedule::builtin("shell"));
      return compute_statistics(mesh).theta_max - before;
    };
    CHECK(growth(Bounds::Holding::solver) <= 1e-9);
    has_grown = has_grown || growth(Bounds::Holding::angles) > 1;
  }
  CHECK(has_grown);
}

TEST_CASE("a polish contracts and inserts as far as it is told to") {
  const auto polished = [](const PolishOptions& options) {
    TetMesh mesh(delaunay_ball(400, 5));
    mesh.set_bounds(Bounds::of(mesh));
    Run run(mesh, kSolverRegistry);
    local_reconnection(run);
    const std::size_t tets = mesh.tet_count();
    const std::size_t vertices = mesh.vertex_count();
    polish(run, options);
    CHECK(to_string(check_integrity(mesh)) == "");
    return std::tuple(figures(mesh), tets, vertices, mesh.vertex_count());
  };
  const auto [plain, tets, vertices, vertices_plain] = polished({.insert = 0, .contract = 0});
  CHECK(vertices_plain == vertices);
  const auto [fewer, t1, v1, vertices_fewer] = polished({.insert = 0, .contract = 2});
  CHECK(vertices_fewer < vertices);
  const auto [more, t2, v2, vertices_more] = polished({.insert = 0.9, .contract = 0});
  CHECK(vertices_more > vertices);
  const auto [bound, t3, v3, v4] = polished({.insert = 0.9, .contract = 0, .grow = 0});
  CHECK(bound.tets <= tets);
  const auto [all, t5, v5, v6] = polished({.insert = 0.9, .contract = 2, .cycles = 6});
  CHECK(all.mean > plain.mean);
  CHECK(all.mean > fewer.mean);
}

TEST_CASE("what is inserted after hold_mean() is round enough") {
  const auto mean_after = [](const std::string& hold) {
    TetMesh mesh(delaunay_ball(300, 3));
    mesh.set_bounds(Bounds::of(mesh));
    Run run(mesh, kSolverRegistry);
    improve(run, Schedule("test.lua", "local_reconnection{} smooth{} " + hold +
                                          " insert_points{} apply('centroid_insertion')"));
    return figures(mesh);
  };
  const Ended free = mean_after("");
  const Ended held = mean_after("hold_mean(quality().mean_ratio)");
  CHECK(held.tets < free.tets);
  CHECK(held.mean > free.mean);
}

TEST_CASE("where one more tet is refused, nothing is inserted") {
  TetMesh mesh(delaunay_ball(300, 3));
  Run run(mesh, kSolverRegistry);
  run.set_most_tets(mesh.tet_count());
  for (const char* name : {"edge_split", "centroid_insertion", "cavity_insertion"}) {
    CAPTURE(name);
    apply(run, {.what = {.operator_name = name}});
    CHECK(run.records.back().accepted() == 0);
    CHECK(run.records.back().attempts() > 0);
  }
}
