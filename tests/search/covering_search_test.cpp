// SPDX-License-Identifier: MIT
// The covering search on small shells whose best covering is known.
#include "search/covering_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/geometry.h"
#include "kernel/judge.h"
#include "kernel/quality.h"

using namespace tetmend;

namespace {

using CoveringTriangle = Covering::Triangle;

/// Points of one shell; the problem of a search refers to them.
struct TestShell {
  Point a;
  Point b;
  std::vector<Point> ring;
  std::vector<Quality> old_sides;

  Quality worst_old() const { return *std::min_element(old_sides.begin(), old_sides.end()); }
  CoveringProblem problem(Quality floor) const {
    CoveringProblem problem;
    problem.a = a;
    problem.b = b;
    problem.ring = ring;
    problem.old_sides = old_sides;
    problem.floor = floor;
    return problem;
  }
};

TestShell make_shell(const Point& a, const Point& b, std::vector<Point> ring) {
  TestShell shell = {a, b, std::move(ring), {}};
  for (std::size_t i = 0; i < shell.ring.size(); ++i) {
    const Point& next = shell.ring[(i + 1) % shell.ring.size()];
    shell.old_sides.push_back(static_cast<Quality>(minimum_sine(a, b, shell.ring[i], next)));
  }
  return shell;
}

/// Ring at equal angles, on a circle or a star, around an axis from -half to half.
TestShell make_round_shell(unsigned m, double half, double odd_radius = 1) {
  std::vector<Point> ring;
  for (unsigned i = 0; i < m; ++i) {
    const double angle = 2 * std::numbers::pi * i / m;
    const double radius = i % 2 == 1 ? odd_radius : 1;
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return make_shell(Point(0, 0, -half), Point(0, 0, half), std::move(ring));
}

/// Octahedron with ring vertices at distance `even` and `odd` from the axis.
TestShell make_octahedron(double even, double odd) {
  return make_shell(Point(0, 0, -1), Point(0, 0, 1),
                    {Point(even, 0, 0), Point(0, odd, 0), Point(-even, 0, 0), Point(0, -odd, 0)});
}

/// The ear p_4 is almost in one plane with ab and p_0. ab is so short that the tets of a full
/// reduction are flat: the rest is best left as it is ([chen, Figure 4]).
TestShell make_eared_shell() {
  return make_shell(
      Point(0, 0, -0.4), Point(0, 0, 0.4),
      {Point(1, 0, 0), Point(0, 1, 0), Point(-1, 0, 0), Point(0, -1, 0), Point(1.5, -0.05, 0)});
}

struct VolumeAndWorst {
  double volume6 = 0;
  double worst = std::numeric_limits<double>::infinity();

  void add(const Point& p0, const Point& p1, const Point& p2, const Point& p3) {
    volume6 += tetmend::volume6(p0, p1, p2, p3);
    worst = std::min(worst, minimum_sine(p0, p1, p2, p3));
  }
};

VolumeAndWorst old_tets(const TestShell& s) {
  VolumeAndWorst tets;
  for (std::size_t i = 0; i < s.ring.size(); ++i) {
    tets.add(s.a, s.b, s.ring[i], s.ring[(i + 1) % s.ring.size()]);
  }
  return tets;
}

VolumeAndWorst new_tets(const TestShell& s, const Covering& covering) {
  VolumeAndWorst tets;
  for (unsigned n = 0; n < covering.triangle_count; ++n) {
    const auto [i, k, j] = covering.triangles[n];
    tets.add(s.a, s.ring[i], s.ring[k], s.ring[j]);
    tets.add(s.ring[i], s.ring[k], s.ring[j], s.b);
  }
  for (unsigned n = 0; n < covering.degree; ++n) {
    tets.add(s.a, s.b, s.ring[covering.core[n]], s.ring[covering.core[(n + 1) % covering.degree]]);
  }
  return tets;
}

std::vector<unsigned> core_of(const Covering& covering) {
  return {covering.core.begin(), covering.core.begin() + covering.degree};
}

/// The triangles, each from its lowest vertex on, in ascending order.
std::vector<CoveringTriangle> triangles_of(const Covering& covering) {
  std::vector<CoveringTriangle> triangles(covering.triangles.begin(),
                                          covering.triangles.begin() + covering.triangle_count);
  for (CoveringTriangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

const std::vector<CoveringTriangle> kDiagonal02 = {{0, 1, 2}, {0, 2, 3}};
const std::vector<CoveringTriangle> kDiagonal13 = {{0, 1, 3}, {1, 2, 3}};

/// Worst qualities of all triangulations of the chain i .. i + d, each ascending and padded.
std::vector<CoveringSearch::Ranking> all_rankings(const TestShell& s, unsigned i, unsigned d) {
  const auto m = static_cast<unsigned>(s.ring.size());
  CoveringSearch::Ranking none;
  none.fill(std::numeric_limits<Quality>::infinity());
  if (d == 1) return {none};
  std::vector<CoveringSearch::Ranking> all;
  const Point& p = s.ring[i];
  const Point& q = s.ring[(i + d) % m];
  for (unsigned k = 1; k < d; ++k) {
    const Point& apex = s.ring[(i + k) % m];
    const auto upper = static_cast<Quality>(minimum_sine(s.a, p, apex, q));
    const auto lower = static_cast<Quality>(minimum_sine(p, apex, q, s.b));
    if (upper <= 0 || lower <= 0) continue;
    for (const auto& left : all_rankings(s, i, k)) {
      for (const auto& right : all_rankings(s, (i + k) % m, d - k)) {
        std::vector<Quality> values = {upper, lower};
        values.insert(values.end(), left.begin(), left.end());
        values.insert(values.end(), right.begin(), right.end());
        std::sort(values.begin(), values.end());
        std::copy_n(values.begin(), none.size(), none.begin());
        all.push_back(none);
      }
    }
  }
  return all;
}

}  // namespace

TEST_CASE("A long edge of degree 3 is removed by the only triangle") {
  const TestShell shell = make_round_shell(3, 1);
  CoveringSearch search;
  Covering covering;
  REQUIRE(search.run(shell.problem(shell.worst_old()), covering));
  CHECK(covering.degree == 0);
  CHECK(covering.tet_count() == 2);
  CHECK(triangles_of(covering) == std::vector<CoveringTriangle>{{0, 1, 2}});
  CHECK(search.evaluations() == 1);
}

TEST_CASE("A short edge of degree 3 stays, because two flat tets are worse than three good ones") {
  const TestShell shell = make_round_shell(3, 0.3);
  CoveringSearch search;
  Covering covering;
  CHECK_FALSE(search.run(shell.problem(shell.worst_old()), covering));
}

TEST_CASE("Two tall tets with a common face become three around a new edge") {
  TestShell sandwich = make_round_shell(3, 0.3);
  sandwich.old_sides.clear();
  CoveringProblem problem = sandwich.problem(0);
  CoveringSearch search;
  Covering covering;
  REQUIRE(search.run(problem, covering));
  CHECK(covering.degree == 3);
  CHECK(covering.tet_count() == 3);
  CHECK(core_of(covering) == std::vector<unsigned>{0, 1, 2});

  problem.allow_core = false;
  REQUIRE(search.run(problem, covering));
  CHECK(triangles_of(covering) == std::vector<CoveringTriangle>{{0, 1, 2}});
}

TEST_CASE("An octahedron is cut along the shorter diagonal") {
  CoveringSearch search;
  Covering covering;
  const TestShell even = make_octahedron(0.8, 1);
  REQUIRE(search.run(even.problem(even.worst_old()), covering));
  CHECK(covering.tet_count() == 4);
  CHECK(triangles_of(covering) == kDiagonal02);
  const TestShell odd = make_octahedron(1, 0.8);
  REQUIRE(search.run(odd.problem(odd.worst_old()), covering));
  CHECK(covering.tet_count() == 4);
  CHECK(triangles_of(covering) == kDiagonal13);
}

TEST_CASE("In a regular octahedron the diagonals tie and the triangle of the lowest indices wins") {
  const TestShell shell = make_octahedron(1, 1);
  CoveringSearch search;
  Covering covering;
  REQUIRE(search.run(shell.problem(0), covering));
  CHECK(triangles_of(covering) == kDiagonal13);
  CHECK(new_tets(shell, covering).worst == doctest::Approx(shell.worst_old()));
}

TEST_CASE("A locked vertex of an octahedron leaves the diagonal that does not end there") {
  const TestShell shell = make_octahedron(0.8, 1);
  CoveringProblem problem = shell.problem(0);
  CoveringSearch search;
  Covering covering;
  for (const unsigned locked : {0u, 2u}) {
    problem.locked_vertices = 1u << locked;
    REQUIRE(search.run(problem, covering));
    CHECK(triangles_of(covering) == kDiagonal13);
  }
  for (const unsigned locked : {1u, 3u}) {
    problem.locked_vertices = 1u << locked;
    REQUIRE(search.run(problem, covering));
    CHECK(triangles_of(covering) == kDiagonal02);
  }
  problem.locked_vertices = 0b0011;
  CHECK_FALSE(search.run(problem, covering));
}

TEST_CASE("Any locked ring edge keeps the edge of a shell") {
  CoveringSearch search;
  Covering covering;
  for (const unsigned m : {3u, 4u, 5u}) {
    const TestShell shell = make_round_shell(m, 1);
    for (unsigned i = 0; i < m; ++i) {
      CoveringProblem problem = shell.problem(0);
      problem.allow_core = false;
      REQUIRE(search.run(problem, covering));
      problem.locked_edges = 1u << i;
      CHECK_FALSE(search.run(problem, covering));
    }
  }
}

TEST_CASE("Locked vertices do not matter where a ring has no chords") {
  const TestShell shell = make_round_shell(3, 1);
  CoveringProblem problem = shell.problem(shell.worst_old());
  problem.locked_vertices = 0b111;
  CoveringSearch search;
  Covering covering;
  CHECK(search.run(problem, covering));
}

TEST_CASE("An ear in one plane with the edge is cut off and the rest of the shell stays") {
  const TestShell shell = make_eared_shell();
  CoveringSearch search;
  Covering covering;
  CoveringProblem problem = shell.problem(shell.worst_old());
  REQUIRE(search.run(problem, covering));
  CHECK(core_of(covering) == std::vector<unsigned>{0, 1, 2, 3});
  CHECK(triangles_of(covering) == std::vector<CoveringTriangle>{{0, 3, 4}});
  CHECK(covering.tet_count() == 6);
  const VolumeAndWorst tets = new_tets(shell, covering);
  CHECK(tets.worst > 3 * shell.worst_old());
  CHECK(tets.volume6 == doctest::Approx(old_tets(shell).volume6).epsilon(1e-12));

  SUBCASE("also if the other vertices and ring edges are locked") {
    problem.locked_vertices = 0b00110;
    problem.locked_edges = 0b00111;
    REQUIRE(search.run(problem, covering));
    CHECK(triangles_of(covering) == std::vector<CoveringTriangle>{{0, 3, 4}});
  }
  SUBCASE("but not if the chord would end at a locked vertex") {
    problem.locked_vertices = 0b01001;
    problem.locked_edges = 0b00010;
    CHECK_FALSE(search.run(problem, covering));
  }
  SUBCASE("but full reduction is taken if there must be no core, though it is worse") {
    problem.allow_core = false;
    REQUIRE(search.run(problem, covering));
    CHECK(covering.degree == 0);
    CHECK(covering.tet_count() == 6);
    CHECK(new_tets(shell, covering).worst < tets.worst);
  }
}

TEST_CASE("A star of 16 points loses its tips, and its edge only if there must be no core") {
  const TestShell shell = make_round_shell(16, 1, 0.4);
  const VolumeAndWorst before = old_tets(shell);
  CoveringProblem problem = shell.problem(shell.worst_old());
  CoveringSearch search;
  ExactCoveringSearch exact;
  Covering covering;
  Covering exact_covering;

  REQUIRE(search.run(problem, covering));
  REQUIRE(exact.run(problem, exact_covering));
  CHECK(core_of(covering) == std::vector<unsigned>{1, 3, 5, 7, 9, 11, 13, 15});
  CHECK(core_of(exact_covering) == core_of(covering));
  CHECK(covering.triangle_count == 8);
  CHECK(covering.tet_count() == 24);
  const double worst = new_tets(shell, covering).worst;
  CHECK(worst > shell.worst_old());

  problem.allow_core = false;
  for (const bool found : {search.run(problem, covering), exact.run(problem, exact_covering)}) {
    REQUIRE(found);
  }
  for (const Covering& full : {covering, exact_covering}) {
    CHECK(full.degree == 0);
    CHECK(full.tet_count() == 28);
    const VolumeAndWorst tets = new_tets(shell, full);
    CHECK(tets.worst > shell.worst_old());
    CHECK(tets.worst < worst);
    CHECK(tets.volume6 == doctest::Approx(before.volume6).epsilon(1e-12));
  }
}

TEST_CASE(
    "Coverings that keep the same worst tet tie in a search by that tet, and least degree wins") {
  TestShell star = make_round_shell(8, 1, 0.4);
  star.old_sides[0] = 0.01f;
  CoveringProblem problem = star.problem(0);
  problem.locked_edges = 0b1;
  BasicCoveringSearch<1> search;
  Covering covering;
  REQUIRE(search.run(problem, covering));
  // No third ring vertex sees ab from the other side of both 0 and 1, so degree 3 is out of reach.
  CHECK(covering.degree == 4);
}

TEST_CASE("No covering is found above a floor that no tet reaches, after one look at each ear") {
  const TestShell shell = make_round_shell(16, 1);
  CoveringSearch search;
  Covering covering;
  CHECK_FALSE(search.run(shell.problem(0.95f), covering));
  CHECK(search.evaluations() <= 16);
  CHECK(search.run(shell.problem(0), covering));
  CHECK(search.evaluations() > 500);
}

TEST_CASE("A new tet must be better than the floor, not as good") {
  const TestShell shell = make_round_shell(3, 1);
  CoveringSearch search;
  Covering covering;
  REQUIRE(search.run(shell.problem(0), covering));
  const auto worst = static_cast<Quality>(new_tets(shell, covering).worst);
  CHECK(search.run(shell.problem(worst - kQualityTolerance), covering));
  CHECK_FALSE(search.run(shell.problem(worst + kQualityTolerance), covering));
}

TEST_CASE("Shells of all sizes from 1e-6 to 1e6 get the same covering") {
  CoveringSearch search;
  for (const TestShell& shell :
       {make_eared_shell(), make_octahedron(0.8, 1), make_round_shell(16, 1, 0.4)}) {
    Covering expected;
    REQUIRE(search.run(shell.problem(shell.worst_old()), expected));
    for (const double scale : {1e-6, 1e6}) {
      CAPTURE(scale);
      TestShell scaled = shell;
      scaled.a *= scale;
      scaled.b *= scale;
      for (Point& p : scaled.ring) p *= scale;
      Covering covering;
      REQUIRE(search.run(scaled.problem(shell.worst_old()), covering));
      CHECK(core_of(covering) == core_of(expected));
      CHECK(triangles_of(covering) == triangles_of(expected));
    }
  }
}

TEST_CASE("A search that is explored tells of each pocket the best of all its triangulations") {
  CoveringSearch search;
  std::size_t seen = 0;
  for (const TestShell& shell :
       {make_eared_shell(), make_octahedron(0.8, 1), make_round_shell(7, 1, 0.6)}) {
    const auto m = static_cast<unsigned>(shell.ring.size());
    search.explore(shell.problem(0));
    for (unsigned i = 0; i < m; ++i) {
      for (unsigned d = 2; d < (i == 0 ? m : m - 1); ++d) {
        CAPTURE(i);
        CAPTURE(d);
        const auto rankings = all_rankings(shell, i, d);
        const auto pocket = search.pocket(i, d);
        REQUIRE(pocket.has_value() == !rankings.empty());
        if (!pocket) continue;
        ++seen;
        const auto best = *std::max_element(rankings.begin(), rankings.end());
        for (std::size_t n = 0; n < best.size(); ++n) {
          if ((*pocket)[n] == best[n]) continue;  // also two infinities, for lack of a tet
          CHECK(static_cast<double>((*pocket)[n]) == doctest::Approx(static_cast<double>(best[n])));
        }
      }
    }
  }
  CHECK(seen > 30);
}

TEST_CASE("An explored search has no pocket below its floor, nor at a locked vertex or side") {
  const TestShell shell = make_round_shell(6, 1);
  CoveringSearch search;
  CoveringProblem problem = shell.problem(0);
  search.explore(problem);
  REQUIRE(search.pocket(1, 2));
  REQUIRE(search.pocket(0, 5));
  problem.locked_vertices = 0b001000;
  search.explore(problem);
  CHECK_FALSE(search.pocket(1, 2));  // its chord is 1 3
  CHECK_FALSE(search.pocket(3, 2));
  CHECK(search.pocket(2, 2));  // 3 is inside
  problem.locked_vertices = 0;
  problem.locked_edges = 0b000100;
  search.explore(problem);
  CHECK_FALSE(search.pocket(1, 2));  // has the side 2 3
  CHECK(search.pocket(3, 2));
  CHECK_FALSE(search.pocket(0, 5));
  search.explore(shell.problem(0.95f));
  for (unsigned i = 0; i < 6; ++i) {
    for (unsigned d = 2; d < (i == 0 ? 6 : 5); ++d) CHECK_FALSE(search.pocket(i, d));
  }
}
