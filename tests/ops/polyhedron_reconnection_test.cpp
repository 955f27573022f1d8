// SPDX-License-Identifier: MIT
// Small polyhedron reconnection: what only it improves, and what it leaves alone.
#include <doctest/doctest.h>

#include "kernel/workspace.h"
#include "tests/support/lone_worker.h"
#include "tests/support/octahedron.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

Verdict reconnect(LoneWorker& worker, const Corners& tet, const ParameterSettings& settings = {}) {
  return worker.attempt("polyhedron_reconnection", worker.tet(tet), settings);
}

std::vector<Target> the_tet(TetHandle t) {
  return {Target::of(t)};
}

std::vector<Target> its_edges(TetHandle t) {
  std::vector<Target> all;
  for (unsigned e = 0; e < 6; ++e) all.push_back(Target::of(TetEdge(t, e)));
  return all;
}

std::vector<Target> its_faces(TetHandle t) {
  std::vector<Target> all;
  for (unsigned f = 0; f < 4; ++f) all.push_back(Target::of(HalfFace(t, f)));
  return all;
}

/// How many attempts at the bad tets succeed.
std::size_t sweep(LoneWorker& worker, std::string_view name,
                  std::vector<Target> (*targets_of)(TetHandle), const ParameterSettings& settings) {
  std::size_t accepted = 0;
  for (const TetHandle t : live_tets(worker.mesh)) {
    for (const Target target : targets_of(t)) {
      if (worker.mesh.is_deleted(t) || worker.mesh.quality(t) >= kBadThreshold) break;
      accepted += worker.attempt(name, target, settings) == Verdict::accepted;
    }
  }
  return accepted;
}

}  // namespace

TEST_CASE("an octahedron around its longest diagonal is divided around the shortest") {
  LoneWorker worker(octahedron(3, 1, 2));
  REQUIRE(reconnect(worker, {0, 1, 2, 3}) == Verdict::accepted);
  CHECK(worker.tets() == kAround24);
  for (const TetHandle t : live_tets(worker.mesh)) CHECK(worker.mesh.label(t) == 7);
}

TEST_CASE("the best division is left alone") {
  LoneWorker worker(octahedron(1, 2, 3));
  CHECK(reconnect(worker, {0, 1, 2, 3}) == Verdict::no_improvement);
}

TEST_CASE("a polyhedron that may not grow far enough finds nothing") {
  LoneWorker worker(octahedron(3, 1, 2));
  CHECK(reconnect(worker, {0, 1, 2, 3}, {{"max_vertices", 5}}) == Verdict::no_improvement);
  CHECK(reconnect(worker, {0, 1, 2, 3}, {{"max_vertices", 6}}) == Verdict::accepted);
}

TEST_CASE("a search without nodes left is a refusal of its own") {
  LoneWorker worker(octahedron(3, 1, 2));
  CHECK(reconnect(worker, {0, 1, 2, 3}, {{"max_nodes", 1}}) == Verdict::budget_spent);
}

TEST_CASE("constrained faces and edges inside are kept") {
  MeshData faces = octahedron(3, 1, 2);
  faces.triangles = {{{0, 1, 3}, 1}};
  LoneWorker with_face(faces);
  CHECK(reconnect(with_face, {0, 1, 2, 3}) == Verdict::no_improvement);
  MeshData edges = octahedron(3, 1, 2);
  edges.edges.push_back({{0, 1}, 1});
  LoneWorker with_edge(edges);
  CHECK(reconnect(with_edge, {0, 1, 2, 3}) == Verdict::constrained);
}

TEST_CASE("a frozen tet is not touched") {
  LoneWorker worker(octahedron(3, 1, 2));
  worker.mesh.freeze([&](TetHandle) { return true; });
  CHECK(reconnect(worker, {0, 1, 2, 3}) == Verdict::constrained);
}

TEST_CASE("an attempt is deferred when the polyhedron may reach what belongs to others") {
  LoneWorker worker(octahedron(3, 1, 2));
  worker.workspace.provide(worker.mesh, 8, 1);
  worker.give_away({4});
  CHECK(reconnect(worker, {0, 1, 2, 3}) == Verdict::deferred);
}

TEST_CASE("a better worst tet is not worth new bad ones, unless it is desperate") {
  // Around 2-4 the worst tet would be 0.35 instead of 0.34, but more of them are bad.
  MeshData data = octahedron(1, 1, 1);
  data.points = {{-3, 0, -8}, {-2, -1, 9}, {4, 1, -4}, {-2, 9, -1}, {-6, -2, 3}, {-4, -4, -1}};
  LoneWorker worker(data);
  CHECK(worker.worst() > kDesperate);
  CHECK(reconnect(worker, {0, 1, 2, 3}) == Verdict::no_improvement);
  REQUIRE(reconnect(worker, {0, 1, 2, 3}, {{"desperate", 1}}) == Verdict::accepted);
  CHECK(worker.tets() == kAround24);
}

TEST_CASE("with a new vertex an octahedron falls into eight tets around it") {
  LoneWorker worker(octahedron(3, 1, 1));
  const Quality before = worker.worst();
  REQUIRE(reconnect(worker, {0, 1, 2, 3}, {{"insert", 1}, {"min_vertices", 6}}) ==
          Verdict::accepted);
  CHECK(worker.tets() == kAround6);
  CHECK(worker.mesh.point(VertexHandle(6)).norm() < 1e-12);  // the mean of the others
  CHECK(worker.worst() > before);
  CHECK_FALSE(worker.mesh.is_fixed(VertexHandle(6)));
}

TEST_CASE("the new vertex counts among the most vertices") {
  LoneWorker worker(octahedron(3, 1, 1));
  CHECK(reconnect(worker, {0, 1, 2, 3}, {{"insert", 1}, {"max_vertices", 6}}) ==
        Verdict::no_improvement);
  CHECK(worker.mesh.vertex_count() == 6);
}

TEST_CASE("an insertion is deferred when the territory has no free slot for a vertex") {
  LoneWorker worker(octahedron(3, 1, 1));
  worker.give_away({});
  CHECK(reconnect(worker, {0, 1, 2, 3}, {{"insert", 1}}) == Verdict::deferred);
}

TEST_CASE("a vertex inside vanishes only with remove") {
  MeshData data = octahedron(1.5, 1.4, 1.6);
  data.points.emplace_back(0.45, 0.45, 0.45);
  data.tets.clear();
  for (std::uint32_t i = 0; i < 4; ++i) {
    data.tets.push_back({{0, 6, 2 + i, 2 + (i + 1) % 4}, 7});
    data.tets.push_back({{6, 1, 2 + i, 2 + (i + 1) % 4}, 7});
  }
  LoneWorker keeping(data);
  CHECK(reconnect(keeping, {1, 2, 3, 6}) == Verdict::no_improvement);
  LoneWorker removing(data);
  REQUIRE(reconnect(removing, {1, 2, 3, 6}, {{"remove", 1}}) == Verdict::accepted);
  CHECK(removing.tets() == kAround24);
  MeshData required = data;
  required.required_vertices = {6};
  LoneWorker fixed(required);
  CHECK(reconnect(fixed, {1, 2, 3, 6}, {{"remove", 1}}) == Verdict::no_improvement);
}

TEST_CASE("with relax, smoothing makes good of a filling that is worse at first") {
  std::size_t plain = 0;
  std::size_t relaxed = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    LoneWorker worker(delaunay_ball(80, seed));
    LoneWorker other(delaunay_ball(80, seed));
    plain += sweep(worker, "polyhedron_reconnection", the_tet, {});
    while (sweep(other, "polyhedron_reconnection", the_tet, {}) > 0) {
    }
    const ParameterSettings relax = {{"relax", 1}, {"insert", 1}, {"remove", 1}};
    relaxed += sweep(other, "polyhedron_reconnection", the_tet, relax);
  }
  CHECK(plain > 5);
  CHECK(relaxed > 5);
}

TEST_CASE("it improves tets that no other way of reconnection can") {
  std::size_t improved = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    LoneWorker worker(delaunay_ball(80, seed));
    while (sweep(worker, "recursive_shell_transformation", its_edges, {}) +
               sweep(worker, "multi_face_removal", its_faces, {}) >
           0) {
    }
    improved += sweep(worker, "polyhedron_reconnection", the_tet, {});
  }
  CHECK(improved > 5);
}
