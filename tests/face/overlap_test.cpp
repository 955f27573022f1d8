// SPDX-License-Identifier: MIT
// Shared volume of tets, against counting of random points.
#include "face/overlap.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "kernel/geometry.h"
#include "tests/support/tets.h"

using namespace tetmend;
using namespace tetmend::test;
using tetmend::face::overlap;

namespace {

double corner_volume(const TetPoints& t) {
  return std::abs(volume6(t[0], t[1], t[2], t[3])) / 6;
}

bool holds(const TetPoints& t, const Point& p) {
  const double all = volume6(t[0], t[1], t[2], t[3]);
  for (std::size_t k = 0; k < 4; ++k) {
    TetPoints part = t;
    part[k] = p;
    if (volume6(part[0], part[1], part[2], part[3]) * all < 0) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("the overlap of two tets is the share of points in both") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(0, 1);
  const auto point = [&] {
    return Point(coordinate(random), coordinate(random), coordinate(random));
  };
  for (int n = 0; n < 20; ++n) {
    const TetPoints a = {point(), point(), point(), point()};
    const TetPoints b = {point(), point(), point(), point()};
    constexpr int kPoints = 40000;
    int both = 0;
    for (int i = 0; i < kPoints; ++i) {
      const Point p = point();
      both += holds(a, p) && holds(b, p);
    }
    const double shared = overlap(a, b);
    CHECK(shared == doctest::Approx(overlap(b, a)).epsilon(1e-9));
    CHECK(std::abs(shared - static_cast<double>(both) / kPoints) < 4e-3);
  }
}

TEST_CASE("a tet shares all with itself, nothing with a neighbour, and parts add up") {
  const TetPoints a = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  CHECK(overlap(a, a) == doctest::Approx(corner_volume(a)));
  CHECK(overlap(a, {a[1], a[0], a[2], a[3]}) == doctest::Approx(corner_volume(a)));
  CHECK(overlap(a, {a[1], a[2], a[3], Point(1, 1, 1)}) == doctest::Approx(0));
  const Point inside(0.2, 0.3, 0.1);
  const TetPoints b = {Point(-1, 0.1, 0), Point(1, 0.2, 0.1), Point(0.3, 1, 0.2), Point(0.2, 0, 2)};
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    TetPoints part = a;
    part[k] = inside;
    sum += overlap(part, b);
  }
  CHECK(sum == doctest::Approx(overlap(a, b)));
}
