// SPDX-License-Identifier: MIT
// What no change may make worse: single tets against a mesh, then judges and whole runs.
#include "kernel/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "contract/zoo.h"
#include "kernel/solver_rulers.h"
#include "kernel/statistics.h"
#include "kernel/tet_mesh.h"
#include "ops/registry.h"
#include "schedule/schedule.h"
#include "tests/support/registry.h"
#include "tests/support/tets.h"

using namespace tetmend;
using namespace tetmend::contract;
using namespace tetmend::test;

namespace {

bool admits(const Bounds& bounds, const TetPoints& p) {
  return bounds.admit(p[0], p[1], p[2], p[3]);
}

/// A tet with an edge along z of the given dihedral angle, in degrees.
TetPoints wedge_points(double angle) {
  const double turn = angle * 3.14159265358979323846 / 180;
  return {Point(0, 0, -0.5), Point(0, 0, 0.5), Point(1, 0, 0),
          Point(std::cos(turn), std::sin(turn), 0)};
}

/// The tet, and apart from it a needle of better angles, by which other figures are bounded.
TetMesh mesh_with_needle(const TetPoints& p) {
  MeshData data;
  data.points.assign(p.begin(), p.end());
  data.tets.push_back({{0, 1, 2, 3}, 0});
  data.points.insert(data.points.end(),
                     {{10, 0, 0}, {11, 0, 0}, {10.5, std::sqrt(0.75), 0}, {10.5, 0.3, 30}});
  data.tets.push_back({{4, 5, 6, 7}, 0});
  return TetMesh(data);
}

/// The figures that have bounds, of a whole mesh.
struct Figures {
  double theta_min, theta_max, mean_ratio, radius_ratio, edge_ratio = 0;

  explicit Figures(const TetMesh& mesh) {
    const MeshStatistics s = compute_statistics(mesh);
    theta_min = s.theta_min;
    theta_max = s.theta_max;
    mean_ratio = summarize(mesh, find_quality_measure("mean_ratio")).worst;
    radius_ratio = summarize(mesh, find_quality_measure("radius_ratio")).worst;
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      if (mesh.is_deleted(TetHandle(i))) continue;
      const TetVertices& v = mesh.vertices(TetHandle(i));
      edge_ratio = std::max(edge_ratio, of_tet(mesh, v));
    }
  }
  static double of_tet(const TetMesh& mesh, const TetVertices& v) {
    return test::edge_ratio(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
  }
};

}  // namespace

TEST_CASE("a tet may have no smaller and no larger angle than the worst of the mesh") {
  const Bounds sharp = Bounds::of(mesh_with_needle(wedge_points(10)));
  CHECK(admits(sharp, wedge_points(10.001)));
  CHECK_FALSE(admits(sharp, wedge_points(9.999)));
  CHECK(admits(sharp, wedge_points(149)));  // within the goal
  CHECK_FALSE(admits(sharp, wedge_points(151)));
  const Bounds blunt = Bounds::of(mesh_with_needle(wedge_points(160)));
  CHECK(admits(blunt, wedge_points(159)));
  CHECK_FALSE(admits(blunt, wedge_points(160.001)));
}

TEST_CASE("of a mesh with bounds the angles get tighter, never looser, and nothing else") {
  MeshData data;
  const TetPoints alone = wedge_points(20);
  data.points.assign(alone.begin(), alone.end());
  data.tets.push_back({{0, 1, 2, 3}, 0});
  TetMesh mesh(data);
  mesh.set_bounds(Bounds::of(mesh_with_needle(wedge_points(10))));
  const Bounds now = Bounds::of(mesh);
  CHECK(admits(now, wedge_points(20.001)));
  CHECK_FALSE(admits(now, wedge_points(19.999)));
  const TetPoints needle = {Point(0, 0, 0), Point(1, 0, 0), Point(0.5, std::sqrt(0.75), 0),
                            Point(0.5, 0.3, 29)};
  CHECK(admits(now, needle));
  TetMesh without(data);
  CHECK_FALSE(admits(Bounds::of(without), needle));
  TetMesh worse = mesh_with_needle(wedge_points(10));
  worse.set_bounds(Bounds::of(mesh_with_needle(wedge_points(20))));
  CHECK_FALSE(admits(Bounds::of(worse), wedge_points(19.999)));
}

TEST_CASE("a mesh without bounds admits all") {
  CHECK(admits({}, wedge_points(0.01)));
  CHECK(Bounds().safe() < -1e30f);
}

TEST_CASE(
    "an inverted tet bounds angles and edges as its mirror image does, and ratios not at all") {
  const auto with_inverted = [](const TetPoints& sharp) {
    MeshData data;
    const TetPoints fine = wedge_points(60);
    data.points.assign(fine.begin(), fine.end());
    data.points.push_back(sharp[3]);
    data.points.insert(data.points.end(), {{50, 0, 0}, {51, 0, 0}, {50, 1, 0}, {50, 0, 1}});
    // Folded back into the larger one, whose volume tells the sense of both.
    data.tets = {{{0, 1, 2, 3}, 0}, {{0, 1, 2, 4}, 0}, {{5, 6, 7, 8}, 0}};
    return TetMesh(data);
  };
  const TetMesh mesh = with_inverted(wedge_points(10));
  REQUIRE(compute_statistics(mesh).inverted == 1);
  const Bounds bounds = Bounds::of(mesh);
  CHECK(admits(bounds, wedge_points(10.001)));
  CHECK_FALSE(admits(bounds, wedge_points(9.999)));
  CHECK_FALSE(admits(bounds, {Point(0, 0, 0), Point(11, 0, 0), Point(0, 1, 0), Point(0, 0, 1)}));
  const TetPoints flat = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1e-9)};
  CHECK_FALSE(admits(bounds, flat));
  const TetPoints inverted = {Point(1, 0, 0), Point(0, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  CHECK(admits(bounds, inverted));
  CHECK_FALSE(admits(Bounds::of(mesh_with_needle(wedge_points(10))), inverted));
}

TEST_CASE("widened tet by tet, or part by part, bounds are those of a mesh of these tets") {
  const TetMesh mesh = mesh_with_needle(wedge_points(10));
  const Bounds expected = Bounds::of(mesh);
  const Bounds none = Bounds::of_goal(mesh.standard());
  std::array<Bounds, 2> parts = {none, none};
  for (std::uint32_t slot = 0; slot < 2; ++slot) {
    const TetVertices& v = mesh.vertices(TetHandle(slot));
    parts[slot].widen(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
  }
  CHECK_FALSE(admits(none, wedge_points(29)));
  CHECK_FALSE(admits(parts[0], {Point(0, 0, 0), Point(1, 0, 0), Point(0.5, std::sqrt(0.75), 0),
                                Point(0.5, 0.3, 29)}));
  Bounds all = parts[1];
  all.widen(parts[0]);
  CHECK(all.under(mesh.standard()).safe() == expected.safe());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  unsigned admitted = 0;
  for (int i = 0; i < 20'000; ++i) {
    TetPoints p;
    for (Point& x : p) x = Point(coordinate(random), coordinate(random), coordinate(random));
    CHECK(admits(all, p) == admits(expected, p));
    admitted += admits(all, p) ? 1 : 0;
  }
  CHECK(admitted > 1000);
  CHECK(admitted < 19'000);
  const TetPoints inverted = {Point(0, 0, 0), Point(0, 1, 0), Point(1, 0, 0), Point(0, 0, 1)};
  CHECK_FALSE(admits(all, inverted));
  all.widen(inverted[0], inverted[1], inverted[2], inverted[3]);
  CHECK(admits(all, inverted));
  CHECK_FALSE(admits(all, wedge_points(0.001)));
}

TEST_CASE("a tet of the quality that is called safe keeps the bounds") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (const double angle : {5.0, 12.0, 170.0}) {
    const TetMesh mesh = mesh_with_needle(wedge_points(angle));
    const Bounds bounds = Bounds::of(mesh);
    unsigned safe = 0;
    for (int i = 0; i < 200'000; ++i) {
      TetPoints p;
      for (Point& x : p) x = Point(coordinate(random), coordinate(random), coordinate(random));
      if (i % 2 == 0) p[1] = p[0] + 0.1 * p[1];  // a short edge
      if (mesh.standard().quality(p[0], p[1], p[2], p[3]) < bounds.safe()) continue;
      ++safe;
      REQUIRE(admits(bounds, p));
      REQUIRE(edge_ratio(p[0], p[1], p[2], p[3]) < 10);
    }
    CHECK(safe > 100);
  }
}

TEST_CASE("no schedule leaves a tet beyond the bounds of its mesh") {
  for (const MeshData& data : {delaunay_ball(120, 3), kuhn_cube(4, 0.35, 2)}) {
    for (const char* name : {"shell", "conservative", "stellar", "quick"}) {
      CAPTURE(name);
      TetMesh mesh(data);
      mesh.set_bounds(Bounds::of(mesh));
      const Figures before(mesh);
      Run run(mesh, kRegistry);
      improve(run, Schedule::builtin(name));
      const Figures now(mesh);
      CHECK(now.theta_min >= before.theta_min - 1e-9);
      CHECK(now.theta_max <= std::max(before.theta_max, 150.0) + 1e-9);
      CHECK(now.mean_ratio >= before.mean_ratio - 1e-9);
      CHECK(now.radius_ratio >= before.radius_ratio - 1e-9);
      CHECK(now.edge_ratio <= std::max(before.edge_ratio, 10.0) + 1e-9);
    }
  }
}

TEST_CASE("no schedule lowers the stable step below that of its mesh") {
  for (const MeshData& data :
       {delaunay_ball(120, 3), kuhn_cube(4, 0.35, 2), kuhn_cube(5, 0.2, 7)}) {
    for (const char* name : {"shell", "conservative", "stellar", "polish", "quick"}) {
      CAPTURE(name);
      TetMesh mesh(data);
      mesh.set_bounds(Bounds::of(mesh, Bounds::Holding::solver));
      const double before = stable_step(mesh);
      REQUIRE(before > 0);
      Run run(mesh, kRegistry);
      improve(run, Schedule::builtin(name));
      CHECK(stable_step(mesh) >= before * (1 - 1e-9));
    }
  }
}

TEST_CASE("to know which stars have thin tets saves time and changes nothing") {
  for (const MeshData& data : {delaunay_ball(120, 3), kuhn_cube(4, 0.35, 2)}) {
    std::array<TetMesh, 2> meshes = {TetMesh(data), TetMesh(data)};
    for (TetMesh& mesh : meshes) {
      // In the order that it has, which forgets the stars of one.
      if (&mesh == &meshes[0]) mesh.collect_garbage();
      mesh.set_bounds(Bounds::of(mesh, Bounds::Holding::solver));
      CHECK(mesh.thin_stars() != nullptr);
      if (&mesh == &meshes[1]) mesh.collect_garbage();
      CHECK((mesh.thin_stars() == nullptr) == (&mesh == &meshes[1]));
      Run run(mesh, kRegistry);
      improve(run, Schedule::builtin("shell"));
      mesh.collect_garbage();
    }
    REQUIRE(meshes[0].vertex_slots() == meshes[1].vertex_slots());
    REQUIRE(meshes[0].tet_slots() == meshes[1].tet_slots());
    for (std::uint32_t v = 0; v < meshes[0].vertex_slots(); ++v) {
      REQUIRE(meshes[0].point(VertexHandle(v)) == meshes[1].point(VertexHandle(v)));
    }
    for (std::uint32_t t = 0; t < meshes[0].tet_slots(); ++t) {
      REQUIRE(meshes[0].vertices(TetHandle(t)) == meshes[1].vertices(TetHandle(t)));
    }
  }
}
