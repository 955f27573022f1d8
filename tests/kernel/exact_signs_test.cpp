// SPDX-License-Identifier: MIT
// Exact signs where products leave the doubles, and sums that only integers hold. CGAL judges the
// rest: exact_signs_oracle_test.cpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "kernel/exact_orientation.h"
#include "kernel/exact_sphere.h"
#include "kernel/exact_sum.h"

using namespace tetmend;

namespace {

constexpr double kMost = std::numeric_limits<double>::max();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();

}  // namespace

TEST_CASE("a sum keeps the smallest product beside the largest") {
  const std::array<double, 3> values = {kMost, -kMost, kLeast};
  ExactSum<3> sum(values);
  CHECK(sum.sign() == 0);
  sum.add({kMost, kMost, kMost});
  CHECK(sum.sign() == 1);
  sum.add({kLeast, -kLeast, kLeast});
  CHECK(sum.sign() == 1);
  sum.add({kMost, -kMost, kMost});
  CHECK(sum.sign() == -1);
  sum.add({kLeast, -kLeast, kLeast}, true);
  CHECK(sum.sign() == 0);
  sum.add({kLeast, kLeast, kLeast});
  CHECK(sum.sign() == 1);
  sum.add({kMost, 0, kMost}, true);
  CHECK(sum.sign() == 1);
}

TEST_CASE("carries run through a sum of many products") {
  const std::array<double, 2> values = {0x1.fffffffffffffp0, 0x1p-52};
  ExactSum<1> sum(values);
  for (int i = 0; i < 1000; ++i) sum.add({values[0]});
  // 1000 (2 - 2^-52) = 2000 - 1000 2^-52
  for (int i = 0; i < 1000; ++i) sum.add({values[0]}, true);
  CHECK(sum.sign() == 0);
  for (int i = 0; i < 1000; ++i) sum.add({values[1]}, true);
  CHECK(sum.sign() == -1);
  for (int i = 0; i < 1001; ++i) sum.add({values[1]});
  CHECK(sum.sign() == 1);
}

TEST_CASE("orientations are exact for the smallest and the largest doubles, and for both at once") {
  for (const double size : {kLeast, 3 * kLeast, 1e-310, 1e-200, 1e-108, 1e103, 1e200, kMost}) {
    CAPTURE(size);
    const Point a(0, 0, 0), b(size, 0, 0), c(0, size, 0), d(0, 0, size);
    CHECK(exact_orientation(a, b, c, d) == 1);
    CHECK(exact_orientation(a, b, d, c) == -1);
    CHECK(exact_orientation(-b, b, c, d) == 1);  // differences overflow
    CHECK_FALSE(is_turned_over(a, b, c, d));
    CHECK(is_turned_over(a, b, d, c));
    CHECK(exact_orientation(a, b, c, {size, size, 0}) == 0);
    CHECK(exact_orientation(a, b, c, {size, size, kLeast}) == 1);
    CHECK(exact_orientation(a, b, c, {size, -size, -kLeast}) == -1);
    CHECK_FALSE(is_turned_over(a, b, c, {size, size, kLeast}));
  }
  // The plane x + y = z.
  const double half = kMost / 2;
  const Point a(0, 0, 0), b(half, 0, half), c(0, half, half);
  CHECK(exact_orientation(a, b, c, {half, half, kMost}) == 0);
  CHECK(exact_orientation(a, b, c, {std::nextafter(half, 0), half, kMost}) == 1);
  CHECK(exact_orientation(a, b, c, {half, half, std::nextafter(kMost, 0)}) == -1);
  CHECK(exact_orientation(a, b, c, {kLeast, kLeast, kLeast}) == -1);
  CHECK(exact_orientation(a, b, c, {kLeast, kLeast, 3 * kLeast}) == 1);
  CHECK(exact_orientation(a, b, c, {kLeast, kLeast, 2 * kLeast}) == 0);
}

TEST_CASE(
    "orientations are exact where differences are no doubles, in every order of the vertices") {
  const double t = 0x1p-60;
  // In the plane x = z.
  const std::array<Point, 4> flat = {{{1, t, 1}, {t, 3, t}, {5, 7 * t, 5}, {-3, 1, -3}}};
  std::array<Point, 4> raised = flat;
  raised[3].z() = std::nextafter(-3, 0);
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  do {
    int sign = -1;  // of (t - 1) 6 t - (3 - t) 4, for the first order
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) sign = order[i] > order[j] ? -sign : sign;
    }
    const auto orientation = [&order](const std::array<Point, 4>& p) {
      return exact_orientation(p[order[0]], p[order[1]], p[order[2]], p[order[3]]);
    };
    CHECK(orientation(flat) == 0);
    CHECK(orientation(raised) == sign);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("spheres are exact for the smallest and the largest doubles") {
  for (const double size : {kLeast, 1e-200, 1e-60, 1.0, 1e60, 1e200, kMost}) {
    CAPTURE(size);
    const Point a(-size, 0, 0), b(size, 0, 0), c(0, size, 0), d(0, 0, size);
    REQUIRE(exact_orientation(a, b, c, d) == 1);
    CHECK(side_of_sphere(a, b, c, d, {0, 0, 0}) == 1);
    CHECK(side_of_sphere(a, b, c, d, {0, -size, 0}) == 0);
    CHECK(side_of_sphere(a, b, c, d, {0, -size, kLeast}) == -1);
    CHECK(side_of_sphere(a, b, c, d, {size, size, 0}) == -1);
    CHECK(side_of_sphere(a, b, d, c, {0, 0, 0}) == -1);  // a negative tet
    CHECK(side_of_sphere(a, b, c, c, {0, 0, 0}) == 0);
  }
}
