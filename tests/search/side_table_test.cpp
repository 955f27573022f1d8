// SPDX-License-Identifier: MIT
// Ranks, sides and overlaps of a few points, the latter against projections on separating axes.
#include "search/side_table.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/exact_orientation.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

SideTable make_table(const std::vector<Point>& points) {
  SideTable table;
  for (const Point& p : points) table.add(p);
  return table;
}

PointMask mask(std::initializer_list<unsigned> points) {
  PointMask all = 0;
  for (const unsigned n : points) all |= PointMask{1} << n;
  return all;
}

std::vector<Point> members(const SideTable& table, PointMask set) {
  std::vector<Point> points;
  for (unsigned n = 0; n < table.size(); ++n) {
    if ((set >> n & 1u) != 0) points.push_back(table.point(n));
  }
  return points;
}

/// Whether the projections on an axis overlap by more than rounding.
bool overlap_on(const Point& axis, const std::vector<Point>& s, const std::vector<Point>& t) {
  const auto by_axis = [&](const Point& x, const Point& y) { return axis.dot(x) < axis.dot(y); };
  const auto [s0, s1] = std::minmax_element(s.begin(), s.end(), by_axis);
  const auto [t0, t1] = std::minmax_element(t.begin(), t.end(), by_axis);
  constexpr double kRounding = 1e-12;
  return axis.dot(*s1) > axis.dot(*t0) + kRounding && axis.dot(*t1) > axis.dot(*s0) + kRounding;
}

/// Convex bodies whose projections on all normals of faces and common normals of edges overlap.
bool overlap_by_axes(const std::vector<Point>& s, const std::vector<Point>& t) {
  std::vector<Point> edges;
  std::vector<Point> axes;
  for (const auto* body : {&s, &t}) {
    for (std::size_t i = 0; i < body->size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) edges.push_back((*body)[i] - (*body)[j]);
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) axes.push_back(edges[i].cross(edges[j]));
  }
  return std::all_of(axes.begin(), axes.end(), [&](const Point& axis) {
    return axis.norm() < 1e-12 || overlap_on(axis.normalized(), s, t);
  });
}

}  // namespace

TEST_CASE("triangles and tets have ranks without gaps, whatever the number of points") {
  unsigned triangles = 0;
  unsigned tets = 0;
  for (unsigned d = 0; d < SideTable::kMaxPoints; ++d) {
    for (unsigned c = 0; c < d; ++c) {
      for (unsigned b = 0; b < c; ++b) {
        REQUIRE(SideTable::rank(b, c, d) == triangles++);
        for (unsigned a = 0; a < b; ++a) REQUIRE(SideTable::rank(a, b, c, d) == tets++);
      }
    }
  }
  CHECK(triangles == 4960);
  CHECK(tets == 35960);
}

TEST_CASE("each triangle knows on which side the other points lie, flat ones on neither") {
  Random random(1);
  std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};  // on one plane
  while (points.size() < 12) points.push_back(random.in_ball(1));
  const SideTable table = make_table(points);
  REQUIRE(table.size() == 12);
  for (unsigned c = 0; c < 12; ++c) {
    for (unsigned b = 0; b < c; ++b) {
      for (unsigned a = 0; a < b; ++a) {
        const SideTable::Sides& sides = table.sides(SideTable::rank(a, b, c));
        for (unsigned d = 0; d < 12; ++d) {
          const int sign = exact_orientation(points[a], points[b], points[c], points[d]);
          REQUIRE((sides.above >> d & 1u) == (sign > 0));
          REQUIRE((sides.below >> d & 1u) == (sign < 0));
        }
      }
    }
  }
}

TEST_CASE("a table that is cleared takes other points") {
  SideTable table = make_table({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}});
  table.clear();
  CHECK(table.size() == 0);
  for (const Point& p : {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, -1)}) {
    table.add(p);
  }
  CHECK(table.sides(SideTable::rank(0, 1, 2)).above == 0);
  CHECK(table.sides(SideTable::rank(0, 1, 2)).below == mask({3}));
}

TEST_CASE("tets on two sides of a face do not overlap, on one side they do") {
  const SideTable table =
      make_table({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2, 0.2, -1}, {0.2, 0.2, 2}});
  CHECK_FALSE(table.overlap(mask({0, 1, 2, 3}), mask({0, 1, 2, 4})));
  CHECK(table.overlap(mask({0, 1, 2, 3}), mask({0, 1, 2, 5})));
  CHECK(table.overlap(mask({0, 1, 2, 3}), mask({0, 1, 2, 3})));
}

TEST_CASE("tets that only touch do not overlap") {
  // Two corners of a cube that share a vertex, an edge, nothing; and one across the diagonal.
  const SideTable table = make_table({{0, 0, 0},
                                      {1, 0, 0},
                                      {0, 1, 0},
                                      {0, 0, 1},
                                      {-1, 0, 0},
                                      {0, -1, 0},
                                      {0, 0, -1},
                                      {3, 3, 3},
                                      {4, 3, 3},
                                      {3, 4, 4}});
  CHECK_FALSE(table.overlap(mask({0, 1, 2, 3}), mask({0, 4, 5, 6})));
  CHECK_FALSE(table.overlap(mask({0, 1, 2, 3}), mask({0, 1, 5, 6})));
  CHECK_FALSE(table.overlap(mask({0, 1, 2, 3}), mask({7, 8, 9, 6})));
}

TEST_CASE("random tets and triangles overlap just when no axis parts them") {
  Random random(2);
  std::size_t apart = 0;
  std::size_t together = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<Point> points(8);
    for (Point& p : points) p = random.in_ball(1);
    const SideTable table = make_table(points);
    std::array<unsigned, 8> order = {0, 1, 2, 3, 4, 5, 6, 7};
    for (unsigned k = 8; k > 1; --k) std::swap(order[k - 1], order[random.index(k)]);
    const unsigned shared = static_cast<unsigned>(random.index(4));
    PointMask s = 0;
    PointMask t = 0;
    for (unsigned k = 0; k < 4; ++k) s |= PointMask{1} << order[k];
    const unsigned corners = random.real() < 0.5 ? 3 : 4;
    for (unsigned k = 0; k < corners; ++k) t |= PointMask{1} << order[4 - shared + k];
    const bool expected = overlap_by_axes(members(table, s), members(table, t));
    REQUIRE(table.overlap(s, t) == expected);
    REQUIRE(table.overlap(t, s) == expected);
    ++(expected ? together : apart);
  }
  CHECK(apart > 3000);
  CHECK(together > 3000);
}
