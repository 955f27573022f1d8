// SPDX-License-Identifier: MIT
// The polyhedron search on small solids that are known by hand; polyhedron_oracle_test.cpp has the
// random ones.
#include "search/polyhedron_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/judge.h"
#include "tests/support/octahedron.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using PolyhedronFace = PolyhedronProblem::Triangle;

struct ClosedSurface {
  std::vector<Point> points;
  std::vector<PolyhedronFace> surface;
};

//            1               Around the edge 0-1, which is not in the surface, the ring 2 3 4 5.
//         / /  \ \           The three diagonals are 0-1, 2-4 and 3-5.
//       2--3----4
//        \  \ 5/
//           0
ClosedSurface octahedron_surface(double h, double x, double y) {
  return {{{0, 0, -h}, {0, 0, h}, {x, 0, 0}, {0, y, 0}, {-x, 0, 0}, {0, -y, 0}},
          {{1, 2, 3}, {1, 3, 4}, {1, 4, 5}, {1, 5, 2}, {0, 3, 2}, {0, 4, 3}, {0, 5, 4}, {0, 2, 5}}};
}

/// Schoenhardt's: a prism over the triangle 0 1 2, the top 3 4 5 turned so that the sides bend
/// inwards along the diagonals 0-4, 1-5, 2-3.
ClosedSurface twisted_prism(double degrees) {
  ClosedSurface solid;
  for (unsigned i = 0; i < 6; ++i) {
    const double turn = (i % 3) * 120 + (i < 3 ? 0 : degrees);
    const double angle = turn * std::numbers::pi / 180;
    solid.points.emplace_back(std::cos(angle), std::sin(angle), i < 3 ? 0 : 1);
  }
  solid.surface = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                   {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  return solid;
}

struct Search {
  explicit Search(ClosedSurface of) : solid(std::move(of)) {
    for (const Point& p : solid.points) search.add(p);
    problem.surface = solid.surface;
  }
  bool run() { return search.run(problem); }
  std::set<Corners> tets() const {
    std::set<Corners> all;
    for (const auto& tet : search.tets()) {
      Corners corners = {tet[0], tet[1], tet[2], tet[3]};
      std::sort(corners.begin(), corners.end());
      all.insert(corners);
    }
    return all;
  }

  ClosedSurface solid;
  PolyhedronSearch search;
  PolyhedronProblem problem;
};

}  // namespace

TEST_CASE("an octahedron is divided around its shortest diagonal") {
  const std::array<std::array<double, 3>, 3> sizes = {{{1, 2, 2}, {2, 1, 2}, {2, 2, 1}}};
  const std::array<std::set<Corners>, 3> expected = {kAround01, kAround24, kAround35};
  for (unsigned i = 0; i < 3; ++i) {
    Search s(octahedron_surface(sizes[i][0], sizes[i][1], sizes[i][2]));
    REQUIRE(s.run());
    CHECK(s.tets() == expected[i]);
    CHECK_FALSE(s.search.was_cut_short());
    for (const auto& [a, b, c, d] : s.search.tets()) {
      const auto& p = s.solid.points;
      CHECK(volume6(p[a], p[b], p[c], p[d]) > 0);
    }
  }
}

TEST_CASE("nothing is found when no tetrahedralisation is above the floor") {
  Search s(octahedron_surface(1, 2, 2));
  REQUIRE(s.run());
  s.problem.floor = s.search.worst();
  CHECK_FALSE(s.run());
  CHECK_FALSE(s.search.was_cut_short());
  s.problem.floor -= 1e-4f;
  CHECK(s.run());
}

TEST_CASE("Schoenhardt's polyhedron has no tetrahedralisation") {
  Search twisted(twisted_prism(30));
  CHECK_FALSE(twisted.run());
  CHECK_FALSE(twisted.search.was_cut_short());
  CHECK(twisted.search.nodes() < 10);
  // Turned the other way, the diagonals bend outwards.
  Search convex(twisted_prism(-30));
  CHECK(convex.run());
  CHECK(convex.search.tets().size() == 4);
}

TEST_CASE("a point inside must be used if it is to be kept, and only then") {
  ClosedSurface with_centre = octahedron_surface(1, 2, 2);
  with_centre.points.emplace_back(0.01, 0.02, 0);
  Search s(with_centre);
  REQUIRE(s.run());
  CHECK(s.tets() == kAround01);
  s.problem.kept = 1u << 6;
  REQUIRE(s.run());
  CHECK(s.search.tets().size() == 8);
  ClosedSurface schoenhardt = twisted_prism(30);
  schoenhardt.points.emplace_back(0, 0, 0.5);
  Search t(schoenhardt);
  REQUIRE(t.run());
  CHECK(t.search.tets().size() == 8);
}

TEST_CASE("a point on a diagonal is kept, although no tet can hold it in its inside") {
  ClosedSurface with_centre = octahedron_surface(1, 2, 2);
  with_centre.points.emplace_back(0, 0, 0);
  Search s(with_centre);
  s.problem.kept = 1u << 6;
  REQUIRE(s.run());
  CHECK(s.search.tets().size() == 8);
}

TEST_CASE("a banned tet is not used") {
  Search s(octahedron_surface(1, 2, 3));
  REQUIRE(s.run());
  REQUIRE(s.tets() == kAround01);
  s.problem.banned = 1u << 0 | 1u << 1 | 1u << 3 | 1u << 4;
  REQUIRE(s.run());
  CHECK(s.tets() != kAround01);
}

TEST_CASE("points may be added between runs") {
  Search s(octahedron_surface(1, 2, 2));
  REQUIRE(s.run());
  s.search.add({0.01, 0.02, 0});
  s.problem.kept = 1u << 6;
  REQUIRE(s.run());
  CHECK(s.search.tets().size() == 8);
  s.search.clear(Standard());
  CHECK(s.search.size() == 0);
}

TEST_CASE("the search ends at the first tetrahedralisation that is good enough") {
  ClosedSurface crooked = octahedron_surface(1, 1, 1);
  crooked.points = {{-3, 0, -11}, {-3, 0, 12}, {10, -3, 1}, {-3, 13, 2}, {-7, 3, 1}, {0, -13, 0}};
  Search s(crooked);
  REQUIRE(s.run());
  const unsigned all_nodes = s.search.nodes();
  const Quality best = s.search.worst();
  s.problem.enough = 0;
  REQUIRE(s.run());
  CHECK(s.search.nodes() == 4);
  CHECK(s.search.nodes() < all_nodes);
  CHECK(s.search.worst() < best);
  s.problem.enough = best;
  REQUIRE(s.run());
  CHECK(s.search.worst() == best);
}

TEST_CASE("a search without nodes left says so, and keeps what it has found") {
  Search s(octahedron_surface(1, 1.1, 1.2));
  s.problem.max_nodes = 3;
  CHECK_FALSE(s.run());
  CHECK(s.search.was_cut_short());
  CHECK(s.search.nodes() == 3);
  s.problem.max_nodes = 4;
  CHECK(s.run());
  CHECK(s.search.nodes() == 4);
}

TEST_CASE("new tets that lack too much in sum are refused") {
  Search s(octahedron_surface(0.3, 2, 3));
  REQUIRE(s.run());
  double lack = 0;
  for (const auto& [a, b, c, d] : s.search.tets()) {
    const auto& p = s.solid.points;
    lack += deficit(static_cast<Quality>(minimum_sine(p[a], p[b], p[c], p[d])));
  }
  REQUIRE(lack > 0);
  s.problem.deficit_limit = lack * 1.001;
  CHECK(s.run());
  s.problem.deficit_limit = lack * 0.999;
  CHECK_FALSE(s.run());
}
