// SPDX-License-Identifier: MIT
// Insertion by cavity on meshes with small whole coordinates: what gives way, what does not, and
// what smoothing around the new vertex adds.
#include <string>

#include <doctest/doctest.h>

#include "kernel/workspace.h"
#include "tests/ops/insertions.h"
#include "tests/support/lone_worker.h"
#include "tests/support/octahedron.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

Verdict insert_in_cavity(LoneWorker& worker, const Corners& tet,
                         const ParameterSettings& settings = {}) {
  return worker.attempt("cavity_insertion", worker.tet(tet), settings);
}

/// Tries each tet of a mesh on a copy of it; how many attempts were accepted.
std::size_t count_accepted(const MeshData& data, const ParameterSettings& settings) {
  std::size_t accepted = 0;
  for (const Corners& tet : LoneWorker(data).tets()) {
    LoneWorker worker(data);
    accepted += insert_in_cavity(worker, tet, settings) == Verdict::accepted ? 1 : 0;
  }
  return accepted;
}

}  // namespace

TEST_CASE("the tets of a long octahedron give way to a vertex in its middle") {
  LoneWorker worker(octahedron(3, 1, 1));
  const Quality before = worker.worst();
  REQUIRE(insert_in_cavity(worker, kTarget) == Verdict::accepted);
  CHECK(worker.tets() == kAround6);
  CHECK(worker.mesh.point(VertexHandle(6)).norm() < 0.1);
  CHECK(worker.worst() > before);
  CHECK_FALSE(worker.mesh.is_fixed(VertexHandle(6)));
  for (const TetHandle t : live_tets(worker.mesh)) CHECK(worker.mesh.label(t) == 7);
}

TEST_CASE("a good tet is not divided") {
  LoneWorker worker(one_tet());
  CHECK(insert_in_cavity(worker, kTarget) == Verdict::no_improvement);
}

TEST_CASE("a flat or inverted tet can be the target") {
  for (const double lift : {0.0, -0.1}) {
    CAPTURE(lift);
    LoneWorker worker(middle_tet(lift));
    std::size_t accepted = 0;
    for (const Corners& tet : worker.tets()) {
      if (worker.worst() > 0 || !worker.tets().contains(tet)) continue;
      accepted += insert_in_cavity(worker, tet) == Verdict::accepted ? 1 : 0;
    }
    CHECK(accepted > 0);
    CHECK(worker.worst() > 0);
  }
}

TEST_CASE("an accepted insertion removes its target, in meshes of all kinds") {
  for (const std::string name : {"ball_60", "cube_5", "folded_cube_4", "tangled_ball_60"}) {
    CAPTURE(name);
    LoneWorker worker(zoo_data(name));
    std::size_t accepted = 0;
    for (const Corners& tet : worker.tets()) {
      if (!worker.tets().contains(tet)) continue;
      if (insert_in_cavity(worker, tet, {{"relax", 0}}) != Verdict::accepted) continue;
      ++accepted;
      CHECK_FALSE(worker.tets().contains(tet));
    }
    CHECK(accepted > 0);
  }
}

TEST_CASE("smoothing and reconnecting around the new vertex makes more insertions succeed") {
  const MeshData ball = zoo_data("ball_60");
  CHECK(count_accepted(ball, {{"relax", 1}}) > count_accepted(ball, {{"relax", 0}}));
}

TEST_CASE("further tries make more insertions succeed") {
  const MeshData cube = zoo_data("cube_5");
  CHECK(count_accepted(cube, {{"tries", 11}}) > count_accepted(cube, {{"tries", 1}}));
}

TEST_CASE("the cavity ends at constrained faces and at other regions") {
  MeshData faces = octahedron(2, 3, 1);
  faces.points[5].y() = -2;
  MeshData regions = faces;
  faces.triangles = {{{0, 1, 3}, 1}, {{0, 1, 5}, 1}};
  regions.tets[1].label = regions.tets[2].label = 8;
  const std::set<Corners> half = {{0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 3, 6}, {0, 1, 5, 6},
                                  {0, 2, 3, 6}, {0, 2, 5, 6}, {1, 2, 3, 6}, {1, 2, 5, 6}};
  for (const MeshData& data : {faces, regions}) {
    LoneWorker worker(data);
    REQUIRE(insert_in_cavity(worker, kTarget, {{"desperate", 2}}) == Verdict::accepted);
    CHECK(worker.tets() == half);
  }
}

TEST_CASE("a better worst tet is not worth many new bad ones, unless it is desperate") {
  MeshData faces = octahedron(2, 3, 1);
  faces.points[5].y() = -2;
  faces.triangles = {{{0, 1, 3}, 1}, {{0, 1, 5}, 1}};
  REQUIRE(LoneWorker(faces).worst() > kDesperate);
  const auto verdict = [&](const ParameterSettings& settings) {
    LoneWorker worker(faces);
    return insert_in_cavity(worker, kTarget, settings);
  };
  CHECK(verdict({}) == Verdict::no_improvement);
  CHECK(verdict({{"desperate", 2}}) == Verdict::accepted);
}

TEST_CASE("the larger the exponent, the less do mild bad tets count against a better worst tet") {
  const MeshData ball = zoo_data("ball_60");
  std::size_t last = 0;
  for (const double exponent : {1, 4, 64}) {
    const std::size_t accepted =
        count_accepted(ball, {{"exponent", exponent}, {"desperate", -1}, {"relax", 0}});
    CHECK(accepted > last);
    last = accepted;
  }
}

TEST_CASE("a constrained edge inside the cavity is kept: the insertion is refused") {
  MeshData data = octahedron(3, 1, 1);
  data.edges.push_back({{0, 1}, 1});
  LoneWorker worker(data);
  CHECK(insert_in_cavity(worker, kTarget) == Verdict::constrained);
}

TEST_CASE("no more than max_tets give way") {
  for (const int most : {1, 2, 3}) {
    CAPTURE(most);
    LoneWorker worker(octahedron(3, 1, 1));
    const ParameterSettings settings = {{"max_tets", most}, {"relax", 0}, {"desperate", 2}};
    const bool taken = insert_in_cavity(worker, kTarget, settings) == Verdict::accepted;
    std::size_t old_tets = 0;
    for (const Corners& tet : worker.tets()) old_tets += tet[3] < 6 ? 1 : 0;
    CHECK(old_tets >= static_cast<std::size_t>(taken ? 4 - most : 4));
  }
}

TEST_CASE("an insertion is deferred when the cavity may reach what belongs to others") {
  LoneWorker worker(octahedron(3, 1, 1));
  worker.workspace.provide(worker.mesh, 8, 1);
  worker.give_away({4});
  CHECK(insert_in_cavity(worker, kTarget) == Verdict::deferred);
}

TEST_CASE("an insertion is deferred when the territory has no free slot for a vertex") {
  LoneWorker worker(octahedron(3, 1, 1));
  worker.give_away({});
  CHECK(insert_in_cavity(worker, kTarget) == Verdict::deferred);
}
