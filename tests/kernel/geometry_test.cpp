// SPDX-License-Identifier: MIT
// Volumes, their certificate, and exact signs.
#include "kernel/geometry.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "kernel/exact_orientation.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("the volume of the unit corner is 1/6, negative when two vertices are swapped") {
  const Point a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1);
  CHECK(volume6(a, b, c, d) == 1);
  CHECK(volume6(a, b, d, c) == -1);
  CHECK(certified_positive(a, b, c, d));
  CHECK_FALSE(certified_positive(a, b, d, c));
  CHECK(certified_sign(a, b, c, d) == 1);
  CHECK(certified_sign(a, b, d, c) == -1);
  CHECK(exact_orientation(a, b, c, d) == 1);
  CHECK(exact_orientation(a, b, d, c) == -1);
}

TEST_CASE("tets of zero volume are not certified and are exactly flat") {
  const Point a(0.1, 0.2, 0.3), b(0.7, 0.2, 0.3), c(0.1, 0.9, 0.3), d(0.4, 0.4, 0.3);
  CHECK_FALSE(certified_positive(a, b, c, d));
  CHECK(certified_sign(a, b, c, d) == 0);
  CHECK(exact_orientation(a, b, c, d) == 0);
  CHECK_FALSE(certified_positive(a, a, a, a));
  CHECK(exact_orientation(a, a, b, c) == 0);
}

TEST_CASE("a certified tet is positive in exact arithmetic, however flat the tets are") {
  Random random(1);
  std::size_t certified = 0;
  std::size_t wrong = 0;
  std::size_t exact_positive = 0;
  std::size_t not_positive = 0;
  for (int i = 0; i < 20000; ++i) {
    // Far from the origin, at many sizes; d within some rounding errors of the plane a b c.
    const double scale = std::pow(2.0, random.real(-40, 40));
    const Point far = random.in_ball(random.real() < 0.5 ? 0 : 1000 * scale);
    const Point a = far + random.in_ball(scale);
    const Point b = far + random.in_ball(scale);
    const Point c = far + random.in_ball(scale);
    const double s = random.real(-1, 2), t = random.real(-1, 2);
    const double off = std::pow(2.0, -random.real(40, 56)) * (far.norm() + scale);
    const Point d = a + s * (b - a) + t * (c - a) + random.in_ball(off);
    const int sign = exact_orientation(a, b, c, d);
    const bool sure = certified_positive(a, b, c, d);
    certified += sure;
    wrong += sure && sign <= 0;
    const int told = certified_sign(a, b, c, d);
    wrong += (told == 1) != sure || (told == -1) != certified_positive(a, b, d, c);
    exact_positive += sign > 0;
    not_positive += sign <= 0;
  }
  CHECK(wrong == 0);
  // The cases are hard on both sides, or this would prove nothing.
  CHECK(certified > 1000);
  CHECK(exact_positive > certified + 1000);
  CHECK(not_positive > 5000);
}

TEST_CASE("a certified tet is positive in exact arithmetic at sizes where products underflow") {
  Random random(2);
  std::size_t wrong = 0;
  for (int i = 0; i < 50000; ++i) {
    const double scale = std::pow(10.0, -random.real(90, 165));
    const Point a = random.in_ball(scale), b = random.in_ball(scale), c = random.in_ball(scale);
    const Point d = a + random.real(-1, 1) * (b - a) + random.real(-1, 1) * (c - a) +
                    random.in_ball(scale * std::pow(2.0, -random.real(0, 56)));
    wrong += certified_positive(a, b, c, d) && exact_orientation(a, b, c, d) <= 0;
  }
  CHECK(wrong == 0);
}

TEST_CASE("coordinates that overflow or are no numbers are never certified") {
  const double huge = 1e200;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(certified_positive({0, 0, 0}, {huge, 0, 0}, {0, huge, 0}, {0, 0, huge}));
  CHECK_FALSE(certified_positive({0, 0, 0}, {nan, 0, 0}, {0, 1, 0}, {0, 0, 1}));
}

TEST_CASE("orientations of a mesh are counted exactly, deleted slots left out") {
  CHECK(count_orientations(make_mesh(zoo_data("middle_tet"))) == ExactOrientation{5, 0, 0});
  CHECK(count_orientations(make_mesh(zoo_data("flat_tet"))) == ExactOrientation{4, 1, 0});
  CHECK(count_orientations(make_mesh(zoo_data("inverted_tet"))) == ExactOrientation{4, 0, 1});
}
