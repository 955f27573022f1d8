// SPDX-License-Identifier: MIT
#include "envelope/cover.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "contract/zoo.h"
#include "tests/support/surface_distance.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

CoverTarget target(const Triangle& t, double tolerance) {
  return {t, 3, tolerance, normal_of(t, 3, 0)};
}

/// The unit square in n x n squares of two triangles, lifted by f.
template <class Lift>
std::vector<CoverTarget> square(unsigned n, double tolerance, const Lift& lift) {
  std::vector<CoverTarget> result;
  const auto at = [&](unsigned i, unsigned j) {
    const double x = static_cast<double>(i) / n;
    const double y = static_cast<double>(j) / n;
    return Point(x, y, lift(x, y));
  };
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < n; ++j) {
      result.push_back(target({at(i, j), at(i + 1, j), at(i + 1, j + 1)}, tolerance));
      result.push_back(target({at(i, j), at(i + 1, j + 1), at(i, j + 1)}, tolerance));
    }
  }
  return result;
}

const Triangle kHalf = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};

}  // namespace

TEST_CASE("a triangle is covered by itself, at distance 0") {
  std::vector<CoverTarget> targets = {target(kHalf, 1e-9)};
  CoverTest test;
  CHECK(test.covers(kHalf, 3, targets));
  CHECK(test.bound() == 0);
  CHECK(targets[0].used);
}

TEST_CASE(
    "a triangle is covered by many in its plane, whatever their sides, and not by all but one") {
  CoverTest test;
  for (const unsigned n : {1u, 2u, 3u, 4u}) {
    std::vector<CoverTarget> targets = square(n, 1e-6, [](double, double) { return 0.0; });
    CHECK(test.covers(kHalf, 3, targets));
    CHECK(test.bound() < 1e-12);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      std::vector<CoverTarget> rest = targets;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      Point middle = Point::Zero();
      for (const Point& p : targets[i].points) middle += p / 3;
      const bool needed = middle.x() + middle.y() < 1 - 1e-9;
      if (needed) CHECK_FALSE(test.covers(kHalf, 3, rest));
    }
  }
}

TEST_CASE("the tolerance decides: lifted by a little less it is covered, by a little more not") {
  CoverTest test;
  for (const double lift : {0.0099, 0.0101}) {
    std::vector<CoverTarget> targets = square(3, 0.01, [&](double, double) { return lift; });
    CHECK(test.covers(kHalf, 3, targets) == (lift < 0.01));
  }
}

TEST_CASE("a hole smaller than the tolerance reaches is covered, a larger one is not") {
  CoverTest test;
  const auto with_hole = [](double half) {  // a slit between two halves of the square
    const double a = 0.3 - half;
    const double b = 0.3 + half;
    std::vector<CoverTarget> targets;
    for (const auto& [from, to] : {std::pair(0.0, a), std::pair(b, 1.0)}) {
      targets.push_back(target({Point(from, 0, 0), Point(to, 0, 0), Point(to, 1, 0)}, 0.01));
      targets.push_back(target({Point(from, 0, 0), Point(to, 1, 0), Point(from, 1, 0)}, 0.01));
    }
    return targets;
  };
  std::vector<CoverTarget> small = with_hole(0.006);
  std::vector<CoverTarget> large = with_hole(0.011);
  CHECK(test.covers(kHalf, 3, small));
  CHECK_FALSE(test.covers(kHalf, 3, large));
}

TEST_CASE("segments are covered by segments") {
  CoverTest test;
  const auto segment = [](double x, double y, double lift) {
    return CoverTarget{
        {Point(x, 0, lift), Point(y, 0, lift), Point(y, 0, lift)}, 2, 0.01, Point(1, 0, 0)};
  };
  const std::array<Point, 3> whole = {Point(0, 0, 0), Point(1, 0, 0), Point(1, 0, 0)};
  std::vector<CoverTarget> parts = {segment(0.7, 1, 0.005), segment(0, 0.3, 0),
                                    segment(0.3, 0.7, -0.005)};
  CHECK(test.covers(whole, 2, parts));
  CHECK(test.bound() >= 0.005);
  CHECK(test.bound() <= 0.01);
  parts.pop_back();
  CHECK_FALSE(test.covers(whole, 2, parts));
}

TEST_CASE("what is proven holds for every sample, and the bound is one") {
  contract::Random random(3);
  CoverTest test;
  int covered = 0;
  for (int round = 0; round < 400; ++round) {
    const double height = random.real(0, 0.06);
    const double tolerance = 0.02;
    const unsigned n = 1 + static_cast<unsigned>(random.index(4));
    std::vector<CoverTarget> targets =
        square(n, tolerance, [&](double, double) { return random.real(-height, height); });
    const auto corner = [&] {
      return Point(random.real(0, 1), random.real(0, 1), random.real(-height, height));
    };
    const Triangle triangle = {corner(), corner(), corner()};
    std::vector<Triangle> surface;
    for (const CoverTarget& t : targets) surface.push_back(t.points);
    for (const bool nearest : {false, true}) {
      if (!test.covers(triangle, 3, targets, nearest)) continue;
      ++covered;
      const double sampled = sampled_distance({triangle}, surface, 20);
      CHECK(sampled <= tolerance);
      CHECK(sampled <= test.bound() + 1e-12);
      CHECK(test.bound() <= tolerance);
    }
  }
  CHECK(covered > 100);
}
