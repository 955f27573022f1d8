// SPDX-License-Identifier: MIT
// Edge split on shells in which a vertex on the edge helps, and in which it does not.
#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/shell.h"
#include "kernel/star.h"
#include "ops/registry.h"
#include "tests/support/lone_worker.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

struct SplitWorker : LoneWorker {
  using LoneWorker::LoneWorker;
  Verdict attempt(std::uint32_t a, std::uint32_t b, const ParameterSettings& settings = {}) {
    return LoneWorker::attempt("edge_split", edge(a, b), settings);
  }
};

/// The edge is much longer than the ring is wide: the tets are thin, their halves are not as thin.
MeshData long_shell() {
  return shell_mesh({.degree = 6, .height = 4});
}

}  // namespace

TEST_CASE("splitting a long edge turns its m tets into 2 m around a new vertex") {
  for (unsigned m = 3; m <= 8; ++m) {
    CAPTURE(m);
    SplitWorker worker(shell_mesh({.degree = m, .height = 4}));
    const Quality before = worker.worst();
    REQUIRE(worker.attempt(0, 1) == Verdict::accepted);
    CHECK(worker.mesh.tet_count() == 2 * m);
    CHECK(worker.mesh.vertex_count() == m + 3);
    CHECK_FALSE(worker.has_edge(0, 1));
    CHECK(worker.worst() > before);
    const VertexHandle v(m + 2);
    CHECK_FALSE(worker.mesh.is_fixed(v));
    for (const TetHandle t : live_tets(worker.mesh)) CHECK(worker.mesh.local_index(t, v) < 4);
    CHECK(count_not_positive(worker.mesh) == 0);
  }
}

TEST_CASE("a shell of good tets is not split") {
  SplitWorker worker(shell_mesh({.degree = 5, .height = 0.55}));
  CHECK(worker.attempt(0, 1) == Verdict::no_improvement);
  CHECK(worker.mesh.vertex_count() == 7);
}

TEST_CASE("edges on boundary and constraint are refused") {
  SplitWorker open(shell_mesh({.degree = 5, .height = 2, .open = true}));
  CHECK(open.attempt(0, 1) == Verdict::constrained);
  SplitWorker closed(long_shell());
  CHECK(closed.attempt(0, 3) == Verdict::constrained);
  MeshData edge = long_shell();
  edge.edges.push_back({{0, 1}, 1});
  CHECK(SplitWorker(edge).attempt(0, 1) == Verdict::constrained);
  MeshData face = long_shell();
  face.triangles.push_back({{0, 1, 2}, 1});
  CHECK(SplitWorker(face).attempt(0, 1) == Verdict::constrained);
}

TEST_CASE("a shell of more than max_degree tets is left alone") {
  CHECK(SplitWorker(long_shell()).attempt(0, 1, {{"max_degree", 5}}) == Verdict::not_applicable);
  CHECK(SplitWorker(long_shell()).attempt(0, 1, {{"max_degree", 6}}) == Verdict::accepted);
}

TEST_CASE("a gain below least_gain is refused") {
  CHECK(SplitWorker(long_shell()).attempt(0, 1, {{"least_gain", 1}}) == Verdict::no_improvement);
}

TEST_CASE("with relax the neighbours are smoothed as well, and fixed ones stay") {
  SplitWorker worker(delaunay_ball(120, 5));
  const TetMesh start = worker.mesh;
  unsigned accepted = 0;
  unsigned moved = 0;
  for (const TetHandle t : live_tets(start)) {
    if (start.quality(t) >= 0.5f || worker.mesh.is_deleted(t)) continue;
    for (unsigned e = 0; e < 6; ++e) {
      const TetMesh before = worker.mesh;
      const auto [a, b] = worker.mesh.vertices(TetEdge(t, e));
      if (worker.attempt(a.index(), b.index(), {{"relax", 1}}) != Verdict::accepted) continue;
      ++accepted;
      for (const VertexHandle v : live_vertices(before)) {
        if (worker.mesh.point(v) == before.point(v)) continue;
        ++moved;
        CHECK_FALSE(before.is_fixed(v));
      }
      break;
    }
  }
  CHECK(accepted > 0);
  CHECK(moved > 0);
}
