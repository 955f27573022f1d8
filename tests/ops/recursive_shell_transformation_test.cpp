// SPDX-License-Identifier: MIT
// The recursion on small pieces cut out of real Delaunay meshes, in which it is known what it takes
// to remove an edge.
#include <algorithm>
#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/shell.h"
#include "kernel/star.h"
#include "kernel/workspace.h"
#include "ops/registry.h"
#include "tests/support/lone_worker.h"
#include "tests/support/two_shells.h"
#include "tests/support/zoo.h"
#include "trace/text_trace.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

MeshData mesh_from(std::vector<Point> points,
                   const std::vector<std::array<std::uint32_t, 4>>& tets) {
  MeshData data;
  data.points = std::move(points);
  for (const auto& tet : tets) data.tets.push_back({tet, 0});
  return data;
}

// As before, but the second shell yields only after a third.
MeshData three_shells() {
  return mesh_from({{0.15, -0.94, 0.29},
                    {-0.15, 0.94, -0.29},
                    {-0.75, 0.97, 0.61},
                    {-0.97, -0.94, 0.3},
                    {-0.41, -0.94, -0.67},
                    {-1.26, 0.85, -0.29},
                    {0.71, 0.15, 0.12},
                    {-1.53, -0.03, 0.61}},
                   {{0, 2, 1, 3},
                    {0, 1, 4, 3},
                    {4, 1, 5, 3},
                    {2, 0, 1, 6},
                    {2, 1, 3, 7},
                    {5, 3, 1, 7},
                    {0, 4, 1, 6},
                    {2, 5, 1, 7}});
}

// The shell of edge 0 1 and that of a link edge. The link edge has a better covering, but it would
// put a new supporting face around 0 1.
MeshData shell_that_would_grow() {
  return mesh_from({{0.71, 0.58, 0.4},
                    {-0.71, -0.58, -0.4},
                    {0.01, 0.58, 1.6},
                    {-0.71, 0.58, 0.41},
                    {1.42, -0.89, 0.8},
                    {0, 0.58, -0.81},
                    {0.16, -1.82, -0.52},
                    {-0.61, -1.19, 2},
                    {0.64, -2.36, 0.6}},
                   {{0, 2, 3, 1},
                    {0, 4, 2, 1},
                    {0, 5, 6, 1},
                    {2, 4, 7, 1},
                    {7, 4, 8, 1},
                    {6, 8, 4, 1},
                    {0, 6, 4, 1},
                    {3, 5, 0, 1}});
}

struct RecursionWorker : LoneWorker {
  using LoneWorker::LoneWorker;
  Verdict attempt(std::uint32_t a, std::uint32_t b, const ParameterSettings& settings = {},
                  std::string_view name = "recursive_shell_transformation") {
    return LoneWorker::attempt(name, edge(a, b), settings);
  }
};

}  // namespace

TEST_CASE("without the filter more link edges are tried") {
  const auto tried = [](const ParameterSettings& settings) {
    RecursionWorker worker(three_shells());
    TextTrace trace;
    Registry registry = Registry::builtin();
    OperatorContext context{worker.mesh, worker.workspace, worker.states, &trace};
    registry.make("recursive_shell_transformation", settings)->attempt(context, worker.edge(0, 1));
    return std::count(trace.text().begin(), trace.text().end(), '\n');
  };
  CHECK(tried({{"filter", 0}}) > tried({{"reflex_only", 0}}));
}

TEST_CASE(
    "an edge that its own shell cannot lose goes when a neighbouring shell is transformed first") {
  RecursionWorker flat(two_shells());
  REQUIRE(count_not_positive(flat.mesh) == 0);
  CHECK(flat.attempt(0, 1, {}, "shell_transformation") == Verdict::no_improvement);
  CHECK(flat.attempt(0, 1, {{"max_level", 0}}) == Verdict::depth_spent);
  RecursionWorker deep(two_shells());
  CHECK(deep.attempt(0, 1, {{"max_level", 1}}) == Verdict::accepted);
  CHECK_FALSE(deep.has_edge(0, 1));
  CHECK(count_not_positive(deep.mesh) == 0);
}

TEST_CASE("three shells in a chain take two levels") {
  RecursionWorker shallow(three_shells());
  CHECK(shallow.attempt(0, 1, {{"max_level", 0}}) == Verdict::depth_spent);
  CHECK(shallow.attempt(0, 1, {{"max_level", 1}}) == Verdict::depth_spent);
  RecursionWorker deep(three_shells());
  CHECK(deep.attempt(0, 1, {{"max_level", 2}}) == Verdict::accepted);
  CHECK_FALSE(deep.has_edge(0, 1));
}

TEST_CASE("more levels than needed give the same mesh") {
  for (const MeshData& data : {two_shells(), three_shells()}) {
    RecursionWorker two(data);
    RecursionWorker fifteen(data);
    two.attempt(0, 1, {{"max_level", 2}});
    fifteen.attempt(0, 1, {{"max_level", 15}});
    CHECK(two.mesh == fifteen.mesh);
  }
}

TEST_CASE("without recursion the operator does what shell transformation does") {
  for (unsigned m = 3; m <= 12; ++m) {
    const MeshData data =
        shell_mesh({.degree = m, .height = 2, .squash = 0.7, .jitter = 0.2, .seed = m});
    RecursionWorker plain(data);
    RecursionWorker recursive(data);
    const Verdict verdict = plain.attempt(0, 1, {}, "shell_transformation");
    const Verdict level_0 = recursive.attempt(0, 1, {{"max_level", 0}});
    CHECK((verdict == Verdict::accepted) == (level_0 == Verdict::accepted));
    CHECK(plain.mesh == recursive.mesh);
  }
}

TEST_CASE("a covering that puts a new face around the edge to be removed is not taken") {
  RecursionWorker worker(shell_that_would_grow());
  REQUIRE(count_not_positive(worker.mesh) == 0);
  const unsigned degree = worker.degree(0, 1);
  CHECK(worker.attempt(0, 1) == Verdict::no_improvement);
  CHECK(worker.degree(0, 1) == degree);
  // Seen from the link edge alone, without an ancestor, the covering is fine.
  unsigned grown = 0;
  Shell shell;
  REQUIRE(find_shell(worker.mesh, worker.edge(0, 1).edge(), shell, Territory()) ==
          ShellKind::closed);
  for (unsigned i = 0; i < shell.degree; ++i) {
    for (const std::uint32_t end : {0u, 1u}) {
      RecursionWorker alone(shell_that_would_grow());
      const Verdict verdict = alone.attempt(end, shell.ring[i].index(), {}, "shell_transformation");
      if (verdict == Verdict::accepted && alone.degree(0, 1) > degree) ++grown;
    }
  }
  CHECK(grown > 0);
}

TEST_CASE("a recursion makes no more transformations than its budget allows") {
  // The shell itself, the shell of the link edge, the shell itself again.
  CHECK(RecursionWorker(two_shells()).attempt(0, 1, {{"budget", 1}}) == Verdict::budget_spent);
  RecursionWorker two(two_shells());
  CHECK(two.attempt(0, 1, {{"budget", 2}}) == Verdict::accepted);  // what was reached is kept
  CHECK(two.has_edge(0, 1));
  RecursionWorker three(two_shells());
  CHECK(three.attempt(0, 1, {{"budget", 3}}) == Verdict::accepted);
  CHECK_FALSE(three.has_edge(0, 1));
}

TEST_CASE("boundary and constraint stop the recursion at its root and on its way") {
  RecursionWorker open(shell_mesh({.degree = 5, .height = 2, .open = true}));
  CHECK(open.attempt(0, 1) == Verdict::constrained);

  // Constrain each interior edge and face of the two shells in turn: they all survive.
  const TetMesh free(two_shells());
  unsigned refused = 0;
  for (const TetHandle t : live_tets(free)) {
    for (unsigned f = 0; f < 4; ++f) {
      if (free.is_boundary(HalfFace(t, f))) continue;
      MeshData data = two_shells();
      const auto v = free.vertices(HalfFace(t, f));
      data.triangles.push_back({{v[0].index(), v[1].index(), v[2].index()}, 1});
      RecursionWorker worker(data);
      if (worker.attempt(0, 1) != Verdict::accepted) ++refused;
    }
    for (unsigned e = 0; e < 6; ++e) {
      const auto [a, b] = free.vertices(TetEdge(t, e));
      MeshData data = two_shells();
      data.edges.push_back({{a.index(), b.index()}, 1});
      RecursionWorker worker(data);
      if (worker.attempt(0, 1) != Verdict::accepted) ++refused;
      CHECK(worker.has_edge(a.index(), b.index()));
    }
  }
  CHECK(refused > 0);
}

TEST_CASE("dropping the reflex rule may only find more") {
  unsigned strict = 0;
  unsigned loose = 0;
  const MeshData data = delaunay_ball(120, 21);
  const TetMesh start(data);
  for (const TetHandle t : live_tets(start)) {
    if (start.quality(t) >= 0.3f) continue;
    for (unsigned e = 0; e < 6; ++e) {
      const auto [a, b] = start.vertices(TetEdge(t, e));
      RecursionWorker first(data);
      strict += first.attempt(a.index(), b.index()) == Verdict::accepted;
      RecursionWorker second(data);
      loose += second.attempt(a.index(), b.index(), {{"reflex_only", 0}}) == Verdict::accepted;
    }
  }
  CHECK(strict > 0);
  CHECK(loose >= strict);
}
