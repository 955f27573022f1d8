// SPDX-License-Identifier: MIT
// Placing a vertex by the mean ratio: against the measure itself and a search in small steps.
#include "search/mean_ratio_ball.h"

#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/geometry.h"
#include "kernel/quality.h"
#include "tests/support/tets.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// The faces of an octahedron whose corners are moved at random, seen from inside.
std::vector<Triangle> random_link(Random& random, double amount) {
  std::array<Point, 6> corners;
  for (unsigned i = 0; i < 6; ++i) {
    corners[i] = Point::Zero();
    corners[i][i / 2] = i % 2 == 0 ? 1 : -1;
    corners[i] += random.in_ball(amount);
  }
  std::vector<Triangle> triangles;
  for (const unsigned i : {0u, 1u}) {
    for (const unsigned j : {2u, 3u}) {
      for (const unsigned k : {4u, 5u}) {
        Triangle t = {corners[i], corners[j], corners[k]};
        if (volume6(Point::Zero(), t[0], t[1], t[2]) < 0) std::swap(t[1], t[2]);
        triangles.push_back(t);
      }
    }
  }
  return triangles;
}

MeanRatioBall ball_of(const std::vector<Triangle>& link, const Point& origin) {
  MeanRatioBall ball;
  ball.clear(origin);
  for (const auto& [a, b, c] : link) ball.add(a, b, c);
  return ball;
}

/// The sum that descend() lowers; infinite outside.
double sum_of_inverses(const std::vector<Triangle>& link, const Point& p) {
  double sum = 0;
  for (const auto& [a, b, c] : link) {
    const double value = mean_ratio(p, a, b, c);
    sum += value > 0 ? 1 / value : 1e300;
  }
  return sum;
}

}  // namespace

TEST_CASE("the mean over a ball is that of the measure, and 0 outside") {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const auto link = random_link(random, 0.3);
    const Point p = random.in_ball(0.5);
    const MeanRatioBall ball = ball_of(link, random.in_ball(1));
    double sum = 0;
    bool is_inside = true;
    for (const auto& [a, b, c] : link) {
      sum += mean_ratio(p, a, b, c);
      is_inside = is_inside && volume6(p, a, b, c) > 0;
    }
    CHECK(ball.mean(p) == doctest::Approx(is_inside ? sum / 8 : 0).epsilon(1e-9));
  }
  CHECK(ball_of(random_link(random, 0), Point::Zero()).mean({5, 0, 0}) == 0);
}

TEST_CASE("the centre is the best place in a regular octahedron") {
  Random random(4);
  const MeanRatioBall ball = ball_of(random_link(random, 0), {0.2, 0.1, -0.3});
  CHECK(ball.descend({0.3, -0.2, 0.25}, 20).norm() < 1e-6);
}

TEST_CASE("no small step leads further down from where a descent ends") {
  Random random(5);
  int tried = 0;
  for (int i = 0; i < 200; ++i) {
    const auto link = random_link(random, 0.35);
    const Point start = random.in_ball(0.4);
    if (sum_of_inverses(link, start) > 1e200) continue;
    ++tried;
    const MeanRatioBall ball = ball_of(link, start);
    const Point end = ball.descend(start, 50);
    const double reached = sum_of_inverses(link, end);
    CHECK(reached <= sum_of_inverses(link, start));
    for (int k = 0; k < 20; ++k) {
      const Point other = end + 0.02 * random.in_ball(1);
      CHECK(sum_of_inverses(link, other) > reached * (1 - 1e-3));
    }
  }
  CHECK(tried > 100);
}

TEST_CASE("a descent from outside stays where it is") {
  Random random(6);
  const auto link = random_link(random, 0.1);
  const Point outside(3, 0, 0);
  CHECK(ball_of(link, outside).descend(outside, 5) == outside);
}
