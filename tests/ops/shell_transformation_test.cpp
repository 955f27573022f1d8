// SPDX-License-Identifier: MIT
// Shell transformation and plain edge removal on shells whose best covering is known.
#include <algorithm>
#include <array>
#include <numbers>
#include <string>
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

struct ShellWorker : LoneWorker {
  using LoneWorker::LoneWorker;
  Verdict attempt(const std::string& name, std::uint32_t a, std::uint32_t b) {
    return LoneWorker::attempt(name, edge(a, b));
  }
};

const std::vector<std::string> kBoth = {"shell_transformation", "edge_removal"};
constexpr double kRegularQuality = 2 * 0.942809041582063366;

/// Around the edge 0 1, ring 2, 3, ...
MeshData shell_around(const Point& a, const Point& b, const std::vector<Point>& ring) {
  MeshData data;
  data.points = {a, b};
  data.points.insert(data.points.end(), ring.begin(), ring.end());
  const auto m = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < m; ++i) data.tets.push_back({{0, 1, 2 + i, 2 + (i + 1) % m}});
  return data;
}

}  // namespace

TEST_CASE("three tets around the axis of two regular tets become these two") {
  for (const std::string& name : kBoth) {
    ShellWorker worker(shell_mesh({.degree = 3, .height = std::numbers::sqrt2}));
    CHECK(worker.attempt(name, 0, 1) == Verdict::accepted);
    CHECK(worker.mesh.tet_count() == 2);
    CHECK_FALSE(worker.has_edge(0, 1));
    for (const Quality q : worker.qualities()) CHECK(q == doctest::Approx(kRegularQuality));
  }
}

TEST_CASE("three good tets around a short edge stay") {
  for (const std::string& name : kBoth) {
    ShellWorker worker(shell_mesh({.degree = 3, .height = 0.4}));
    CHECK(worker.attempt(name, 0, 1) == Verdict::no_improvement);
    CHECK(worker.mesh.tet_count() == 3);
  }
}

TEST_CASE("four tets around the longest diagonal of an octahedron turn to the shortest") {
  for (const std::string& name : kBoth) {
    ShellWorker worker(shell_around({0, 0, -1.2}, {0, 0, 1.2},
                                    {{0.8, 0, 0}, {0, 1, 0}, {-0.8, 0, 0}, {0, -1, 0}}));
    CHECK(worker.attempt(name, 0, 1) == Verdict::accepted);
    CHECK(worker.mesh.tet_count() == 4);
    CHECK_FALSE(worker.has_edge(0, 1));
    CHECK(worker.has_edge(2, 4));
    CHECK_FALSE(worker.has_edge(3, 5));
    // By symmetry all four are alike.
    CHECK(worker.qualities().front() == doctest::Approx(worker.qualities().back()));
    CHECK(worker.attempt(name, 2, 4) == Verdict::no_improvement);
  }
}

TEST_CASE("a regular shell of five, whose edge is short, has no better covering") {
  for (const std::string& name : kBoth) {
    ShellWorker worker(shell_mesh({.degree = 5, .height = 0.55}));
    CHECK(worker.attempt(name, 0, 1) == Verdict::no_improvement);
  }
}

TEST_CASE("a long edge is removed for every ring of up to twelve") {
  for (unsigned m = 3; m <= 12; ++m) {
    CAPTURE(m);
    for (const std::string& name : kBoth) {
      ShellWorker worker(shell_mesh({.degree = m, .height = 3}));
      const std::vector<Quality> before = worker.qualities();
      if (worker.attempt(name, 0, 1) != Verdict::accepted) {
        CHECK(m > 5);  // the tets become too thin at the ends of long chords
        continue;
      }
      CHECK_FALSE(worker.has_edge(0, 1));
      CHECK(worker.mesh.tet_count() == 2 * (m - 2));
      CHECK(worker.qualities().front() > before.front());
    }
  }
}

TEST_CASE("a partial reduction keeps the edge with a smaller shell where removal is refused") {
  const MeshData data = shell_around(
      {0, 0, -1}, {0, 0, 1},
      {{-0.2, -0.6, 0.3}, {0.8, 0.6, 0.4}, {0.3, 1.8, 0.4}, {-0.3, 0.6, 0}, {-0.4, -0.4, -0.5}});
  ShellWorker removal(data);
  CHECK(removal.attempt("edge_removal", 0, 1) == Verdict::no_improvement);
  ShellWorker worker(data);
  CHECK(worker.attempt("shell_transformation", 0, 1) == Verdict::accepted);
  CHECK(worker.mesh.tet_count() == 6);
  REQUIRE(worker.has_edge(0, 1));
  Shell shell;
  REQUIRE(find_shell(worker.mesh, worker.edge(0, 1).edge(), shell, Territory()) ==
          ShellKind::closed);
  CHECK(shell.degree == 4);
  // Of the three tets that were replaced.
  const Comparison& comparison = worker.states.comparison;
  CHECK(comparison.worst_now() > comparison.worst_before() + 0.1f);
}

TEST_CASE("an edge on the boundary is refused as constrained") {
  for (const std::string& name : kBoth) {
    ShellWorker open(shell_mesh({.degree = 5, .height = 2, .open = true}));
    CHECK(open.attempt(name, 0, 1) == Verdict::constrained);
    ShellWorker closed(shell_mesh({.degree = 3, .height = std::numbers::sqrt2}));
    CHECK(closed.attempt(name, 0, 2) == Verdict::constrained);
    CHECK(closed.attempt(name, 2, 3) == Verdict::constrained);
  }
}

TEST_CASE("an edge that is constrained, lies on a constrained face or between labels is refused") {
  const MeshData free = shell_mesh({.degree = 3, .height = std::numbers::sqrt2});
  MeshData edge = free;
  edge.edges.push_back({{1, 0}, 1});
  MeshData face = free;
  face.triangles.push_back({{3, 0, 1}, 1});
  MeshData regions = free;
  regions.tets[1].label = 1;
  for (const std::string& name : kBoth) {
    CHECK(ShellWorker(free).attempt(name, 0, 1) == Verdict::accepted);
    CHECK(ShellWorker(edge).attempt(name, 0, 1) == Verdict::constrained);
    CHECK(ShellWorker(face).attempt(name, 0, 1) == Verdict::constrained);
    CHECK(ShellWorker(regions).attempt(name, 0, 1) == Verdict::constrained);
  }
}

TEST_CASE("a ring that is too large to be searched is refused") {
  for (const std::string& name : kBoth) {
    for (const unsigned m : {17u, 40u}) {
      ShellWorker worker(shell_mesh({.degree = m, .height = 3}));
      CHECK(worker.attempt(name, 0, 1) == Verdict::not_applicable);
    }
  }
}

TEST_CASE("a flat tet and an inverted one are removed through an edge of theirs") {
  for (const double lift : {0.0, -0.1}) {
    ShellWorker worker(middle_tet(lift));
    REQUIRE(worker.qualities().front() <= 0);
    bool accepted = false;
    for (const auto& [a, b] : std::vector<std::array<std::uint32_t, 2>>{{0, 2}, {1, 3}}) {
      accepted = accepted || (worker.has_edge(a, b) &&
                              worker.attempt("shell_transformation", a, b) == Verdict::accepted);
    }
    CHECK(accepted);
    CHECK(count_not_positive(worker.mesh) == 0);
  }
}
