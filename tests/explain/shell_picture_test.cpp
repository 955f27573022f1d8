// SPDX-License-Identifier: MIT
#include "explain/shell_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "search/covering_search.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::explain;

namespace {

const VertexHandle kA(0);
const VertexHandle kB(1);

ShellPicture picture(const test::ShellShape& shape) {
  const SlotMesh mesh{TetMesh(test::shell_mesh(shape))};
  return picture_of_shell(mesh, find_slot_shell(mesh, kA, kB));
}

/// What the operators would search in the shell of a picture.
struct ShellProblem {
  ShellProblem(const SlotMesh& mesh, const ShellPicture& s) {
    for (const VertexHandle v : s.ring) ring.push_back(mesh.point(v));
    for (const auto& side : s.before.core) sides.push_back(side.quality);
    problem.standard = mesh.standard();
    problem.a = mesh.point(s.a);
    problem.b = mesh.point(s.b);
    problem.ring = ring;
    problem.old_sides = sides;
    problem.locked_vertices = s.locks.vertices;
    problem.locked_edges = s.locks.edges;
  }

  std::vector<Point> ring;
  std::vector<Quality> sides;
  CoveringProblem problem;
};

/// Worst quality of the best complete triangulation, by the search of the operators.
double best_removal(const SlotMesh& mesh, const ShellPicture& s) {
  ShellProblem shell(mesh, s);
  shell.problem.allow_core = false;
  CoveringSearch search;
  Covering covering;
  if (!search.run(shell.problem, covering)) return 0;
  double worst = std::numeric_limits<double>::infinity();
  for (unsigned n = 0; n < covering.triangle_count; ++n) {
    const auto& [i, k, j] = covering.triangles[n];
    const Standard& standard = mesh.standard();
    worst = std::min(
        {worst, standard.quality(shell.problem.a, shell.ring[i], shell.ring[k], shell.ring[j]),
         standard.quality(shell.ring[i], shell.ring[k], shell.ring[j], shell.problem.b)});
  }
  return worst;
}

}  // namespace

TEST_CASE("the best complete triangulation is as good as the one that the operators find") {
  unsigned possible = 0;
  for (unsigned degree = 3; degree <= 9; ++degree) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const test::ShellShape shape{.degree = degree, .jitter = 0.25, .seed = seed};
      const SlotMesh mesh{TetMesh(test::shell_mesh(shape))};
      const ShellPicture s = picture(shape);
      CAPTURE(degree);
      CAPTURE(seed);
      CHECK(s.full.worst == doctest::Approx(best_removal(mesh, s)));
      if (s.full.worst > 0) ++possible;
      CHECK(s.full.triangles.size() == (s.full.worst > 0 ? degree - 2 : 0));
    }
  }
  CHECK(possible > 10);
}

TEST_CASE("the old mesh is a core of all sides, and its worst tet the floor") {
  const ShellPicture s = picture({.degree = 7, .squash = 0.5});
  CHECK(s.before.core.size() == 7);
  CHECK(s.before.triangles.empty());
  Quality worst = std::numeric_limits<Quality>::infinity();
  for (const auto& side : s.before.core) {
    CHECK(side.to == (side.from + 1) % 7);
    worst = std::min(worst, side.quality);
  }
  CHECK(s.floor == worst);
}

TEST_CASE("pockets above the old tets are those of the operators' search, with its locks") {
  std::size_t usable = 0;
  std::size_t others = 0;
  for (unsigned n = 0; n < 24; ++n) {
    const unsigned degree = 4 + n % 6;
    const SlotMesh mesh{TetMesh(test::shell_mesh(
        {.degree = degree, .squash = n % 2 == 0 ? 0.7 : 0.35, .jitter = 0.25, .seed = n}))};
    const SlotShell shell = find_slot_shell(mesh, kA, kB);
    const std::vector<std::array<VertexHandle, 2>> ancestors = {{kA, shell.ring[1]},
                                                                {shell.ring[3], shell.ring[2]}};
    const ShellPicture s = picture_of_shell(mesh, shell, ancestors);
    CHECK(s.locks.vertices == 0b10);
    CHECK(s.locks.edges == 0b100);
    ShellProblem same(mesh, s);
    const Quality floor = std::max(s.floor, Quality{0});  // of some shells, a tet is inverted
    same.problem.floor = floor;
    CoveringSearch search;
    search.explore(same.problem);
    for (unsigned i = 0; i < degree; ++i) {
      for (unsigned d = 2; d + 1 < degree; ++d) {
        const PocketRanking& drawn = s.pocket(i, (i + d) % degree);
        const auto found = search.pocket(i, d);
        REQUIRE(found.has_value() == (drawn[0] > floor));
        if (found) CHECK(*found == drawn);
        ++(found ? usable : others);
      }
    }
  }
  CHECK(usable > 10);
  CHECK(others > 10);
}

TEST_CASE("locks are told in a sentence that names the corners") {
  const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = 5}))};
  const SlotShell shell = find_slot_shell(mesh, kA, kB);
  CHECK(locks_text(picture_of_shell(mesh, shell)).empty());
  const std::vector<std::array<VertexHandle, 2>> ancestors = {{kB, VertexHandle(4)},
                                                              {VertexHandle(5), VertexHandle(6)}};
  CHECK(locks_text(picture_of_shell(mesh, shell, ancestors)) ==
        "Locked, as a caller is to remove an edge there: chords at 4, pockets at the side 5 6.");
}

TEST_CASE("a polygon with more corners than are searched is drawn without chords") {
  const ShellPicture s = picture({.degree = kMaxSearchRing + 1});
  CHECK(s.before.core.size() == kMaxSearchRing + 1);
  CHECK(s.pockets.empty());
  CHECK(s.full.triangles.empty());
  CHECK(chords_of(s).empty());
}

TEST_CASE(
    "chords are the diagonals that have a pocket, best first, with the pockets at both sides") {
  const ShellPicture s = picture({.degree = 6, .jitter = 0.1});
  const std::vector<Chord> chords = chords_of(s);
  CHECK(chords.size() == 6 * 3 / 2);
  for (std::size_t k = 0; k < chords.size(); ++k) {
    const Chord& c = chords[k];
    CHECK(c.from + 1 < c.to);
    CHECK_FALSE((c.from == 0 && c.to == 5));
    CHECK(c.on == s.pocket(c.from, c.to));
    CHECK(c.back == s.pocket(c.to, c.from));
    if (k > 0) CHECK(c.best() <= chords[k - 1].best());
  }
}

TEST_CASE("tets become triangles and sides of a core, and a foreign vertex makes no covering") {
  const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = 5}))};
  const ShellPicture s = picture_of_shell(mesh, find_slot_shell(mesh, kA, kB));
  const auto p = [&](std::size_t i) { return s.ring[i]; };
  // The ear 0 1 2, and a core of 0 2 3 4.
  std::vector<TetVertices> tets = {{kA, p(0), p(1), p(2)}, {p(0), p(1), p(2), kB},
                                   {kA, kB, p(0), p(2)},   {kA, kB, p(2), p(3)},
                                   {kA, kB, p(3), p(4)},   {kA, kB, p(4), p(0)}};
  const FlatCovering covering = covering_of(mesh, s, tets);
  REQUIRE(covering.triangles.size() == 1);
  CHECK(covering.triangles[0].corners == std::array<unsigned, 3>{0, 1, 2});
  REQUIRE(covering.core.size() == 4);
  CHECK(covering.core[0].from == 0);
  CHECK(covering.core[0].to == 2);
  tets.push_back({kA, kB, p(0), VertexHandle(99)});
  CHECK(covering_of(mesh, s, tets).triangles.empty());
}

TEST_CASE("the polygon is drawn counterclockwise in the unit circle, its first corner on top") {
  const ShellPicture s = picture({.degree = 6});
  CHECK(s.place(0).y() == doctest::Approx(1));
  CHECK(s.place(1).x() < 0);
  for (std::size_t i = 0; i < 6; ++i) CHECK(s.place(i).norm() == doctest::Approx(1));
}

TEST_CASE("a sandwich is the polygon around its triangles") {
  const SlotMesh mesh{TetMesh(test::sandwich(5, 0.6))};
  // Apexes and ring as the tets name them.
  const TetVertices first = mesh.vertices(TetHandle(0));
  VertexHandle a;
  for (const VertexHandle v : first) {
    const auto with_v = tets_around(mesh, std::array{v});
    if (with_v.size() == 3 && (v == VertexHandle(0) || v == VertexHandle(1))) a = v;
  }
  REQUIRE(a.is_valid());
  const VertexHandle b(1 - a.index());
  std::vector<std::array<VertexHandle, 3>> triangles;
  for (const TetHandle t : tets_around(mesh, std::array{a})) {
    triangles.push_back(others(mesh.vertices(t), a));
  }
  const ShellPicture s = picture_of_sandwich(mesh, a, b, triangles);
  CHECK(s.ring.size() == 5);
  CHECK(s.before.triangles.size() == 3);
  CHECK(s.before.core.empty());
  CHECK(s.floor > 0);
  CHECK(s.full.worst >= s.floor);
}
