// SPDX-License-Identifier: MIT
// The 3-2 flip on a shell with small whole coordinates, and each reason to refuse.
#include <doctest/doctest.h>

#include "tests/support/lone_worker.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

//          1             The edge 0-1 stands on the middle of the triangle 2 3 4. The three tets
//        / | \           are 0 1 2 3, 0 1 3 4 and 0 1 4 2. After the flip, the triangle parts one
//       2--|--3          tet above from one below. `lift` moves the triangle up along the edge.
//        \ 4 /
//          0
MeshData three_tets(double height, double lift = 0) {
  MeshData data;
  data.points = {{0, 0, -height}, {0, 0, height}, {2, 0, lift}, {-1, 2, lift}, {-1, -2, lift}};
  data.tets = {{{0, 1, 2, 3}, 7}, {{0, 1, 3, 4}, 7}, {{0, 1, 4, 2}, 7}};
  return data;
}

Verdict flip_3_2(LoneWorker& worker, std::uint32_t a, std::uint32_t b) {
  return worker.attempt("flip_3_2", worker.edge(a, b));
}

Verdict flip_3_2(const MeshData& data, std::uint32_t a, std::uint32_t b) {
  LoneWorker worker(data);
  return flip_3_2(worker, a, b);
}

}  // namespace

TEST_CASE("three high tets around an edge give way to the two at the triangle of the ring") {
  LoneWorker worker(three_tets(3));
  const Quality before = worker.worst();
  REQUIRE(flip_3_2(worker, 0, 1) == Verdict::accepted);
  CHECK(worker.tets() == std::set<Corners>{{0, 2, 3, 4}, {1, 2, 3, 4}});
  CHECK(worker.worst() > before);
  for (const TetHandle t : live_tets(worker.mesh)) CHECK(worker.mesh.label(t) == 7);
}

TEST_CASE("a 3-2 flip undoes what a 2-3 flip would prefer, and refuses") {
  CHECK(flip_3_2(three_tets(0.5), 0, 1) == Verdict::no_improvement);
}

TEST_CASE("a 3-2 flip of an edge that passes beside the triangle of its ring is inverted") {
  CHECK(flip_3_2(three_tets(3, 4), 0, 1) == Verdict::inverted);
}

TEST_CASE("a shell of another degree is nothing for a 3-2 flip") {
  for (const unsigned m : {4u, 5u}) {
    CHECK(flip_3_2(shell_mesh({.degree = m, .height = 3}), 0, 1) == Verdict::not_applicable);
  }
}

TEST_CASE("a 3-2 flip refuses edges on boundary and constraint") {
  CHECK(flip_3_2(three_tets(3), 0, 2) == Verdict::constrained);
  MeshData edge = three_tets(3);
  edge.edges.push_back({{0, 1}, 1});
  MeshData face = three_tets(3);
  face.triangles.push_back({{0, 1, 3}, 1});
  MeshData regions = three_tets(3);
  regions.tets[2].label = 8;
  for (const MeshData& data : {edge, face, regions}) {
    CHECK(flip_3_2(data, 0, 1) == Verdict::constrained);
  }
}

TEST_CASE("a 3-2 flip is deferred when a vertex of the ring belongs to others") {
  LoneWorker worker(three_tets(3));
  const Target edge = Target::of(TetEdge(TetHandle(0), 0));  // in 0 1 2 3
  worker.give_away({4});
  CHECK(worker.attempt("flip_3_2", edge) == Verdict::deferred);
}
