// SPDX-License-Identifier: MIT
// Bad tets that surfaces force: known cases, and bounds that no mesh may break.
#include "schedule/limit/surface_limit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "envelope/envelope.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/integrity.h"
#include "kernel/statistics.h"
#include "schedule/schedule.h"
#include "tests/support/threads.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Corners 0 .. n along a ridge of the given angle (degrees), and two vertices beside each: n
/// prisms of three tets each.
//
//      0 ---- 1 ---- 2     ridge along x
//     / \    / \    / \    low side and high side at distance 1
MeshData ridge(unsigned n, double degrees) {
  const double half = degrees * std::numbers::pi / 360;
  MeshData data;
  for (unsigned i = 0; i <= n; ++i) {
    const double x = i;
    data.points.insert(data.points.end(), {Point(x, 0, 0), Point(x, std::cos(half), std::sin(half)),
                                           Point(x, std::cos(half), -std::sin(half))});
  }
  const auto add = [&](std::array<std::uint32_t, 4> v) {
    const auto& p = data.points;
    if (volume6(p[v[0]], p[v[1]], p[v[2]], p[v[3]]) < 0) std::swap(v[2], v[3]);
    data.tets.push_back({v, 0});
  };
  for (unsigned i = 0; i < n; ++i) {
    const std::uint32_t a = 3 * i;
    add({a, a + 1, a + 2, a + 3});
    add({a + 1, a + 2, a + 3, a + 4});
    add({a + 2, a + 3, a + 4, a + 5});
  }
  return data;
}

/// A ball squeezed flat: sharp all around, and thin.
MeshData flat_ball(std::uint64_t seed, unsigned points = 80) {
  MeshData data = delaunay_ball(points, seed);
  for (Point& p : data.points) p.z() *= 0.1;
  return data;
}

void improve_in_place(TetMesh& mesh) {
  Registry registry = Registry::builtin();
  Run run(mesh, registry);
  improve(run);
}

void check_same_bounds(const SurfaceLimit& a, const SurfaceLimit& b) {
  CHECK(a.n_forced == b.n_forced);
  CHECK(a.q_worst == b.q_worst);
  CHECK(a.theta_min == b.theta_min);
  CHECK(a.theta_max == b.theta_max);
}

}  // namespace

TEST_CASE("a cube forces no bad tet, however bad the tets inside are") {
  TetMesh mesh(kuhn_cube(3, 0.39, 4));
  const SurfaceLimit limit = compute_surface_limit(mesh);
  CHECK(limit.n_bad > 5);
  CHECK(limit.n_bad == quality_indicators(mesh).n_bad);
  CHECK(limit.n_forced == 0);
  CHECK(limit.bad_by(Hindrance::surface) == 0);
  CHECK(limit.bad_by(Hindrance::search) + limit.bad_by(Hindrance::no_free_vertex) == limit.n_bad);
  // One tet fills a right angle, and two would have 45 degrees each.
  CHECK(*limit.theta_min >= 45);
  CHECK(*limit.q_worst >= 0.7071);
  CHECK(limit.theta_max.value_or(90) < 150);
}

TEST_CASE("a sharp ridge forces a bad tet at each of its edges, and bounds the angles") {
  const TetMesh one(ridge(1, 10));
  const SurfaceLimit limit = compute_surface_limit(one);
  CHECK(limit.n_forced == 1);
  REQUIRE(limit.theta_min.has_value());
  REQUIRE(limit.q_worst.has_value());
  CHECK(*limit.theta_min == doctest::Approx(10).epsilon(2e-4));
  CHECK(*limit.theta_min >= 10);
  CHECK(*limit.q_worst == doctest::Approx(std::sin(10 * std::numbers::pi / 180)).epsilon(2e-4));
  for (const unsigned n : {2u, 5u}) {
    CAPTURE(n);
    CHECK(compute_surface_limit(TetMesh(ridge(n, 10))).n_forced >= n);
  }
}

TEST_CASE("a ridge of more than 30 degrees can be filled well") {
  CHECK(compute_surface_limit(TetMesh(ridge(3, 29))).n_forced >= 3);
  CHECK(compute_surface_limit(TetMesh(ridge(3, 31))).n_forced == 0);
}

TEST_CASE("a bad tet alone is forced by its surface, and its smallest angle is the bound") {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0.4, 0.06}};
  data.tets = {{{0, 1, 2, 3}, 0}};
  const TetMesh mesh(data);
  const SurfaceLimit limit = compute_surface_limit(mesh);
  const MeshStatistics statistics = compute_statistics(mesh);
  CHECK(limit.n_forced == 1);
  CHECK(limit.bad_by(Hindrance::surface) == 1);
  constexpr double kStep = 0.0011;
  REQUIRE(limit.theta_min.has_value());
  CHECK(*limit.theta_min >= statistics.theta_min);
  CHECK(*limit.theta_min <= statistics.theta_min + kStep);
  // An apex further down could serve the wall, so the largest angle is bounded less well.
  REQUIRE(limit.theta_max.has_value());
  CHECK(*limit.theta_max <= statistics.theta_max);
  REQUIRE(limit.q_worst.has_value());
  CHECK(*limit.q_worst == doctest::Approx(statistics.q_worst).epsilon(1e-3));
}

TEST_CASE("where the one tet that could fill a sector is bad, halves of the sector are the best") {
  // 50 degrees at the edge 0 1, but the third vertices of its walls lie far apart along the edge.
  const double turn = 50 * std::numbers::pi / 180;
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {-4, std::cos(turn), std::sin(turn)}, {5, 1, 0}};
  data.tets = {{{0, 1, 3, 2}, 0}};
  const SurfaceLimit limit = compute_surface_limit(TetMesh(data));
  CHECK(limit.n_forced == 1);
  REQUIRE(limit.theta_min.has_value());
  CHECK(*limit.theta_min <= 25.0011);
}

TEST_CASE("two sharp sectors beside a face that stands free are forced by a constraint") {
  // Two tets of 20 degrees each at the edge 0 1; the face between them is named or not. Together
  // they are good.
  const auto fan = [](bool named, double dent = 0) {
    MeshData data;
    data.points = {{0, 0, -0.5}, {0, 0, 0.5}};
    for (const double degrees : {0.0, 20.0, 40.0}) {
      const double turn = degrees * std::numbers::pi / 180;
      // The middle lies in the plane of the other two, so that one tet without it fits.
      const double radius = degrees == 20 ? std::cos(turn) - dent : 1;
      data.points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0);
    }
    data.tets = {{{0, 1, 2, 3}, 0}, {{0, 1, 3, 4}, 0}};
    if (named) data.triangles = {{{0, 1, 3}, 1}};
    return data;
  };
  const SurfaceLimit limit = compute_surface_limit(TetMesh(fan(true)));
  CHECK(limit.n_bad == 2);
  CHECK(limit.n_forced == 2);
  CHECK(limit.bad_by(Hindrance::constraint) == 2);
  CHECK(*limit.theta_min == doctest::Approx(20).epsilon(1e-3));
  // Vertex 3 stays on the surface: one of the two tets stands on the wall 0 2 3 whatever is inside.
  CHECK(compute_surface_limit(TetMesh(fan(false))).n_forced == 1);
  // Nearer to the edge, it is in the way of the one tet. Then two or more share 40 degrees: one of
  // those on the two walls is bad, and both walls say so of each other.
  CHECK(compute_surface_limit(TetMesh(fan(false, 0.2))).n_forced == 1);
}

TEST_CASE("needles of triangles alone force nothing") {
  // Walls forty times as long as they are wide, at right angles to each other.
  MeshData data = kuhn_cube(3, 0, 1);
  for (Point& p : data.points) p.z() *= 40;
  const SurfaceLimit limit = compute_surface_limit(TetMesh(data));
  CHECK(limit.n_bad == limit.bad_by(Hindrance::search) + limit.bad_by(Hindrance::no_free_vertex));
  CHECK(limit.n_forced == 0);
}

TEST_CASE("frozen bad tets are told apart, and their faces are walls") {
  TetMesh mesh(kuhn_cube(3, 0.39, 4));
  const SurfaceLimit before = compute_surface_limit(mesh);
  TetHandle worst;
  for (const TetHandle t : live_tets(mesh)) {
    if (!worst.is_valid() || mesh.quality(t) < mesh.quality(worst)) worst = t;
  }
  mesh.freeze([&](TetHandle t) { return t == worst; });
  const SurfaceLimit limit = compute_surface_limit(mesh);
  CHECK(limit.bad_by(Hindrance::frozen) == 1);
  CHECK(limit.n_bad == before.n_bad - 1);
  CHECK(limit.n_bad == quality_indicators(mesh).n_bad);
  CHECK(limit.bad_by(Hindrance::constraint) > 0);  // the neighbours, whose vertices are fixed now
}

TEST_CASE("no improvement breaks the bounds, and bounds do not depend on the tets between walls") {
  std::vector<NamedMesh> meshes = zoo();
  meshes.push_back({"ridge", ridge(4, 12)});
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    meshes.push_back({"flat_ball_" + std::to_string(seed), flat_ball(seed)});
  }
  for (const char* name : {"sheet", "folded_sheet", "two_materials"}) {
    meshes.push_back(
        {name, read_mesh(std::string(TETMEND_SOURCE_DIR "/assets/meshes/") + name + ".mesh")});
  }
  for (const NamedMesh& named : meshes) {
    CAPTURE(named.name);
    TetMesh mesh(named.data);
    if (count_not_positive(mesh) > 0) continue;
    const SurfaceLimit before = compute_surface_limit(mesh);
    improve_in_place(mesh);
    const SurfaceLimit after = compute_surface_limit(mesh);
    const MeshStatistics statistics = compute_statistics(mesh);
    check_same_bounds(before, after);
    CHECK(after.n_forced <= after.n_bad);
    CHECK(statistics.theta_min <= after.theta_min.value_or(180));
    CHECK(statistics.theta_max >= after.theta_max.value_or(0));
    CHECK(statistics.q_worst <= after.q_worst.value_or(1));
    const std::size_t forced = after.bad_by(Hindrance::surface);
    CHECK(forced + after.bad_by(Hindrance::constraint) >= after.n_forced);
  }
}

TEST_CASE("the limit is the same on any number of threads") {
  const TetMesh mesh(ridge(300, 20));
  const SurfaceLimit one = on_threads(1, [&] { return compute_surface_limit(mesh); });
  const SurfaceLimit four = on_threads(4, [&] { return compute_surface_limit(mesh); });
  check_same_bounds(one, four);
  CHECK(one.bad == four.bad);
  CHECK(one.n_forced >= 300);
}

TEST_CASE("a ridge that may move proves nothing, unless its sides stay in their planes") {
  TetMesh near(ridge(5, 10));
  near.set_surface_guard(Envelope::of(near, {.share = 0.1, .kept = {}}));
  const SurfaceLimit moving = compute_surface_limit(near);
  CHECK(moving.n_bad > 0);
  CHECK(moving.n_forced == 0);
  CHECK_FALSE(moving.theta_min.has_value());
  CHECK_FALSE(moving.theta_max.has_value());
  CHECK_FALSE(moving.q_worst.has_value());
  CHECK(moving.bad_by(Hindrance::surface) == 0);

  TetMesh flat(ridge(5, 10));
  flat.set_surface_guard(Envelope::of(flat, {.kept = {}}));
  const SurfaceLimit limit = compute_surface_limit(flat);
  CHECK(limit.n_forced == 1);  // its five edges may become one
  CHECK(limit.bad_by(Hindrance::surface) >= 5);
  REQUIRE(limit.theta_min.has_value());
  CHECK(*limit.theta_min >= 10);
  CHECK(*limit.theta_min <= 10.002);
  CHECK(*limit.q_worst == doctest::Approx(std::sin(10 * std::numbers::pi / 180)).epsilon(2e-4));

  TetMesh blunt(ridge(5, 31));
  blunt.set_surface_guard(Envelope::of(blunt, {.kept = {}}));
  CHECK(compute_surface_limit(blunt).n_forced == 0);
}

TEST_CASE("named triangles inside prove the same where the surface may move") {
  MeshData data = delaunay_ball(60, 2);
  const TetMesh plain(data);
  TetHandle worst;  // away from the surface
  for (const TetHandle t : live_tets(plain)) {
    const TetVertices& v = plain.vertices(t);
    if (std::any_of(v.begin(), v.end(), [&](VertexHandle w) { return plain.is_boundary(w); })) {
      continue;
    }
    if (!worst.is_valid() || plain.quality(t) < plain.quality(worst)) worst = t;
  }
  REQUIRE(worst.is_valid());
  REQUIRE(misses_goal(plain, worst));
  for (unsigned f = 0; f < 4; ++f) {
    const auto v = plain.vertices(HalfFace(worst, f));
    data.triangles.push_back({{v[0].index(), v[1].index(), v[2].index()}, 7});
  }
  TetMesh mesh(data);
  const std::size_t fixed = compute_surface_limit(mesh).bad_by(Hindrance::constraint);
  mesh.set_surface_guard(Envelope::of(mesh, {.share = 0.05, .kept = {}}));
  const SurfaceLimit limit = compute_surface_limit(mesh);
  CHECK(limit.n_forced >= 1);
  CHECK(limit.bad_by(Hindrance::surface) == 0);
  CHECK(limit.bad_by(Hindrance::constraint) > 0);
  CHECK(limit.bad_by(Hindrance::constraint) <= fixed);
}

TEST_CASE("no improvement with a moving surface breaks the bounds") {
  std::vector<NamedMesh> meshes = {{"ridge", ridge(4, 12)}, {"regions", two_regions()}};
  meshes.push_back({"flat_ball", flat_ball(1, 30)});
  meshes.push_back({"sheet", read_mesh(TETMEND_SOURCE_DIR "/assets/meshes/sheet.mesh")});
  for (const NamedMesh& named : meshes) {
    for (const double share : {0.0, 0.05}) {
      CAPTURE(named.name);
      CAPTURE(share);
      TetMesh mesh(named.data);
      mesh.set_surface_guard(Envelope::of(mesh, {.share = share, .kept = {}}));
      const SurfaceLimit before = compute_surface_limit(mesh);
      Registry registry = Registry::builtin();
      Run run(mesh, registry);
      improve(run, Schedule::builtin("surface"));
      const SurfaceLimit after = compute_surface_limit(mesh);
      check_same_bounds(before, after);
      const MeshStatistics statistics = compute_statistics(mesh);
      CHECK(after.n_forced <= after.n_bad);
      CHECK(statistics.theta_min <= after.theta_min.value_or(180));
      CHECK(statistics.theta_max >= after.theta_max.value_or(0));
      CHECK(statistics.q_worst <= after.q_worst.value_or(1));
    }
  }
}
