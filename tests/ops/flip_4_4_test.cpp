// SPDX-License-Identifier: MIT
// The 4-4 flip on octahedra with small whole coordinates, and each reason to refuse.
#include <doctest/doctest.h>

#include "tests/support/lone_worker.h"
#include "tests/support/octahedron.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

Verdict flip_4_4(LoneWorker& worker, std::uint32_t a, std::uint32_t b) {
  return worker.attempt("flip_4_4", worker.edge(a, b));
}

Verdict flip_4_4(const MeshData& data, std::uint32_t a, std::uint32_t b) {
  LoneWorker worker(data);
  return flip_4_4(worker, a, b);
}

}  // namespace

TEST_CASE("four tets around a long diagonal give way to four around the shorter of the others") {
  LoneWorker along_x(octahedron(5, 2, 3));
  const Quality before = along_x.worst();
  REQUIRE(flip_4_4(along_x, 0, 1) == Verdict::accepted);
  CHECK(along_x.tets() == kAround24);
  CHECK(along_x.worst() > before);
  for (const TetHandle t : live_tets(along_x.mesh)) CHECK(along_x.mesh.label(t) == 7);

  LoneWorker along_y(octahedron(5, 3, 2));
  REQUIRE(flip_4_4(along_y, 0, 1) == Verdict::accepted);
  CHECK(along_y.tets() == kAround35);
}

TEST_CASE("where the ring is not convex, the diagonal inside it is taken") {
  //   3            Ring seen from above: 2 lies behind the line from 3 to 5.
  //   | \ ___
  //   |  2   4
  //   | /
  //   5
  MeshData data = octahedron(3, 1, 2);
  data.points[2] = {0.5, 0, 0};
  data.points[3] = {1, 2, 0};
  data.points[4] = {-2, 0, 0};
  data.points[5] = {1, -2, 0};
  LoneWorker worker(data);
  REQUIRE(flip_4_4(worker, 0, 1) == Verdict::accepted);
  CHECK(worker.tets() == kAround24);
}

TEST_CASE("a 4-4 flip leaves the shortest diagonal where it is") {
  CHECK(flip_4_4(octahedron(2, 3, 4), 0, 1) == Verdict::no_improvement);
}

TEST_CASE("a 4-4 flip of an edge that passes beside its ring is inverted") {
  CHECK(flip_4_4(octahedron(3, 2, 2, 4), 0, 1) == Verdict::inverted);
}

TEST_CASE("a shell of another degree is nothing for a 4-4 flip") {
  for (const unsigned m : {3u, 5u}) {
    CHECK(flip_4_4(shell_mesh({.degree = m, .height = 3}), 0, 1) == Verdict::not_applicable);
  }
}

TEST_CASE("a 4-4 flip refuses edges on boundary and constraint") {
  CHECK(flip_4_4(octahedron(5, 2, 3), 0, 2) == Verdict::constrained);
  MeshData edge = octahedron(5, 2, 3);
  edge.edges.push_back({{0, 1}, 1});
  MeshData face = octahedron(5, 2, 3);
  face.triangles.push_back({{0, 1, 3}, 1});
  MeshData regions = octahedron(5, 2, 3);
  regions.tets[2].label = 8;
  for (const MeshData& data : {edge, face, regions}) {
    CHECK(flip_4_4(data, 0, 1) == Verdict::constrained);
  }
}

TEST_CASE("a 4-4 flip is deferred when a vertex of the ring belongs to others") {
  LoneWorker worker(octahedron(5, 2, 3));
  const Target edge = Target::of(TetEdge(TetHandle(0), 0));  // in 0 1 2 3
  worker.give_away({4});
  CHECK(worker.attempt("flip_4_4", edge) == Verdict::deferred);
}
