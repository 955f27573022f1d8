// SPDX-License-Identifier: MIT
// The search for an apex: against triangles whose best tet is known, and against sampled tets.
#include "search/apex_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "tests/support/tets.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// A tet on a triangle of these angles (degrees) can have all its angles at least this far from 0
/// and 180.
bool reaches(std::array<double, 3> corners, double degrees) {
  for (double& corner : corners) corner *= kDegree;
  const AngleRange range{degrees * kDegree, (180 - degrees) * kDegree};
  return has_apex(corners, {range, range, range}, range);
}

struct Sample {
  std::array<double, 3> corners{};  // of the base
  std::array<double, 3> base{};     // dihedral angles, by opposite corner
  std::array<double, 3> side{};
};

double corner_angle(const Point& at, const Point& a, const Point& b) {
  return std::acos((a - at).normalized().dot((b - at).normalized()));
}

/// A random tet that is not too flat, its base some triangle of the unit ball.
Sample random_sample(Random& random) {
  for (;;) {
    const std::array<Point, 4> p = {random.in_ball(1), random.in_ball(1), random.in_ball(1),
                                    random.in_ball(1)};
    if (volume6(p[0], p[1], p[2], p[3]) < 1e-3) continue;
    Sample sample;
    for (unsigned i = 0; i < 3; ++i) {
      sample.corners[i] = corner_angle(p[i], p[(i + 1) % 3], p[(i + 2) % 3]);
    }
    const auto angles = dihedral_angles(p[0], p[1], p[2], p[3]);
    for (unsigned i = 0; i < 3; ++i) {
      sample.base[i] = angles[kEdgeOf[(i + 1) % 3][(i + 2) % 3]] * kDegree;
      sample.side[i] = angles[kEdgeOf[i][3]] * kDegree;
    }
    return sample;
  }
}

}  // namespace

TEST_CASE("the best angles on a triangle are those that its shape is known to allow") {
  // The regular tet has the largest smallest angle of all tets.
  CHECK(reaches({60, 60, 60}, 70.5));
  CHECK(!reaches({60, 60, 60}, 70.6));
  // Three corners nearly in a line: the largest of t1, t2 - t1, 180 - t2 - t3, t3 is 45 at best.
  CHECK(reaches({0.01, 179.98, 0.01}, 44.9));
  CHECK(!reaches({0.01, 179.98, 0.01}, 45.2));
  // Two corners nearly at one place: the two faces at the long edges and their common edge share
  // 180 degrees.
  CHECK(reaches({89.99, 89.99, 0.02}, 59.9));
  CHECK(!reaches({89.99, 89.99, 0.02}, 60.2));
}

TEST_CASE("every tet is found when the ranges are its own angles") {
  Random random(5);
  for (int n = 0; n < 2000; ++n) {
    const Sample tet = random_sample(random);
    std::array<AngleRange, 3> base;
    for (unsigned i = 0; i < 3; ++i) {
      base[i] = {std::max(0.0, tet.base[i] - random.real(0, 0.5)),
                 std::min(std::numbers::pi, tet.base[i] + random.real(0, 0.5))};
    }
    const auto [low, high] = std::minmax_element(tet.side.begin(), tet.side.end());
    CHECK(has_apex(tet.corners, base, {*low, *high}));
  }
}

TEST_CASE("narrow ranges hold an apex only where the cosine law puts the sides") {
  Random random(6);
  for (int n = 0; n < 500; ++n) {
    const Sample tet = random_sample(random);
    std::array<AngleRange, 3> base;
    for (unsigned i = 0; i < 3; ++i) base[i] = {tet.base[i], tet.base[i]};
    const auto [low, high] = std::minmax_element(tet.side.begin(), tet.side.end());
    constexpr double kMiss = 1e-3;
    CHECK(!has_apex(tet.corners, base, {*low + kMiss, std::numbers::pi}));
    CHECK(!has_apex(tet.corners, base, {0, *high - kMiss}));
  }
}

TEST_CASE("three planes that lean outward meet below the base, which is no apex") {
  const std::array<double, 3> corners = {60 * kDegree, 60 * kDegree, 60 * kDegree};
  const AngleRange obtuse{91 * kDegree, 150 * kDegree};
  const AngleRange side{0, std::numbers::pi};
  CHECK(!has_apex(corners, {obtuse, obtuse, obtuse}, side));
  CHECK(has_apex(corners, {obtuse, obtuse, AngleRange{30 * kDegree, 40 * kDegree}}, side));
}

TEST_CASE("an empty range holds no apex") {
  const std::array<double, 3> corners = {60 * kDegree, 60 * kDegree, 60 * kDegree};
  const AngleRange wide{0.1, 3};
  CHECK(has_apex(corners, {wide, wide, wide}, wide));
  CHECK(!has_apex(corners, {wide, AngleRange{0.5, 0.4}, wide}, wide));
}
