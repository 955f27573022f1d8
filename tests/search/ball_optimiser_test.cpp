// SPDX-License-Identifier: MIT
// The placement of a vertex in its ball, against finite differences, random search and brute force.
#include "search/ball_optimiser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "kernel/geometry.h"
#include "tests/support/tets.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

constexpr BallOptimiser::Limits kBallToTheEnd = {.steps = 1000, .enough = 1, .least_gain = 1e-9};
const double kRegularSine = 2 * std::numbers::sqrt2 / 3;

/// The faces of an octahedron of the given radius, seen from inside as the optimiser wants them.
std::vector<Triangle> octahedron_faces(double radius) {
  std::vector<Triangle> triangles;
  for (const double x : {-radius, radius}) {
    for (const double y : {-radius, radius}) {
      for (const double z : {-radius, radius}) {
        Triangle t = {Point(x, 0, 0), Point(0, y, 0), Point(0, 0, z)};
        if (volume6(Point::Zero(), t[0], t[1], t[2]) < 0) std::swap(t[1], t[2]);
        triangles.push_back(t);
      }
    }
  }
  return triangles;
}

/// An octahedron whose corners are moved at random.
std::vector<Triangle> random_ball(Random& random, double amount) {
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
        if ((i + j + k) % 2 == 1) std::swap(t[1], t[2]);
        triangles.push_back(t);
      }
    }
  }
  return triangles;
}

void load(BallOptimiser& ball, const std::vector<Triangle>& triangles) {
  ball.clear(Standard());
  for (const Triangle& t : triangles) ball.add(t[0], t[1], t[2]);
}

double direct_worst(const std::vector<Triangle>& triangles, const Point& p) {
  double worst = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) worst = std::min(worst, minimum_sine(p, t[0], t[1], t[2]));
  return worst;
}

/// The best of many random places, by shrinking steps.
double random_search(const std::vector<Triangle>& triangles, Point p, Random& random) {
  double best = direct_worst(triangles, p);
  double radius = 0.3;
  for (int i = 0; i < 4000; ++i) {
    const Point trial = p + random.in_ball(radius);
    const double value = direct_worst(triangles, trial);
    if (value > best) {
      best = value;
      p = trial;
    } else if (i % 40 == 39) {
      radius *= 0.85;
    }
  }
  return best;
}

/// The shortest vector in the hull of every subset of up to four points by its normal equations.
Point shortest_by_enumeration(const std::vector<Point>& points) {
  Point best = points[0];
  const auto consider = [&](const std::vector<Point>& subset) {
    const auto n = static_cast<Eigen::Index>(subset.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, n + 1);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        system(i, j) = subset[static_cast<std::size_t>(i)].dot(subset[static_cast<std::size_t>(j)]);
      }
      system(i, n) = system(n, i) = 1;
    }
    right(n) = 1;
    const Eigen::VectorXd weights = system.fullPivLu().solve(right);
    Point x = Point::Zero();
    double sum = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!(weights(i) >= -1e-12)) return;
      x += weights(i) * subset[static_cast<std::size_t>(i)];
      sum += weights(i);
    }
    if (std::abs(sum - 1) < 1e-6 && x.norm() < best.norm()) best = x;
  };
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    consider({points[i]});
    for (std::size_t j = i + 1; j < n; ++j) {
      consider({points[i], points[j]});
      for (std::size_t k = j + 1; k < n; ++k) {
        consider({points[i], points[j], points[k]});
        for (std::size_t l = k + 1; l < n; ++l) {
          consider({points[i], points[j], points[k], points[l]});
        }
      }
    }
  }
  return best;
}

}  // namespace

TEST_CASE("the worst of a ball is the smallest minimum sine, tet by tet") {
  Random random(1);
  BallOptimiser ball;
  for (int trial = 0; trial < 100; ++trial) {
    const auto triangles = random_ball(random, 0.5);
    load(ball, triangles);
    REQUIRE(ball.size() == 8);
    const Point p = random.in_ball(0.9);  // often outside: negative values
    const double worst = ball.worst(p);
    CHECK(worst == doctest::Approx(direct_worst(triangles, p)).epsilon(1e-12));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Triangle& t = triangles[i];
      const double direct = minimum_sine(p, t[0], t[1], t[2]);
      CHECK(ball.quality(i) == doctest::Approx(direct).epsilon(1e-12));
    }
  }
}

TEST_CASE(
    "a ball tells whether its worst exceeds a bound, call after call, and keeps what does not") {
  Random random(12);
  unsigned above = 0;
  unsigned below = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<Triangle> triangles;  // many more than are evaluated side by side
    for (int i = 0; i < 5; ++i) {
      for (const Triangle& t : random_ball(random, 0.3)) triangles.push_back(t);
    }
    BallOptimiser ball;
    load(ball, triangles);
    Point kept = random.in_ball(0.3);
    ball.worst(kept);
    for (int trial = 0; trial < 20; ++trial) {
      const Point p = random.in_ball(0.3);
      const double worst = direct_worst(triangles, p);
      // Above, below and near the truth.
      const double least = worst + 0.1 * (trial % 5 - 2) + 0.001;
      const double told = ball.worst_above(p, least);
      if (worst > least) {
        CHECK(told == doctest::Approx(worst));
        kept = p;
        ++above;
      } else {
        CHECK(told <= least);
        ++below;
      }
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle& t = triangles[i];
        CHECK(ball.quality(i) == doctest::Approx(minimum_sine(kept, t[0], t[1], t[2])));
      }
    }
  }
  CHECK(above > 100);
  CHECK(below > 100);
}

TEST_CASE("a ball keeps its triangles when its arrays grow") {
  Random random(2);
  BallOptimiser ball;
  std::vector<Triangle> triangles;
  for (int i = 0; i < 500; ++i) {
    triangles.push_back({random.in_ball(1), random.in_ball(1), random.in_ball(1)});
    ball.add(triangles.back()[0], triangles.back()[1], triangles.back()[2]);
  }
  const Point p(0.1, 0.2, 0.3);
  CHECK(ball.worst(p) == doctest::Approx(direct_worst(triangles, p)).epsilon(1e-12));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    const double direct = minimum_sine(p, t[0], t[1], t[2]);
    CHECK(ball.quality(i) == doctest::Approx(direct).epsilon(1e-9));
  }
}

TEST_CASE("the first step of a single tet follows the gradient found by finite differences") {
  Random random(3);
  BallOptimiser ball;
  int checked = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Triangle t = {random.in_ball(1), random.in_ball(1), random.in_ball(1)};
    ball.clear(Standard());
    ball.add(t[0], t[1], t[2]);
    Point p = random.in_ball(1);
    const double start = ball.worst(p);
    if (start < 0.05 || start > 0.6) continue;
    // Only where one sine is the lowest by far is the direction its gradient.
    const auto angles = dihedral_angles(p, t[0], t[1], t[2]);
    std::array<double, 6> sines{};
    for (std::size_t e = 0; e < 6; ++e) sines[e] = std::sin(angles[e] * std::numbers::pi / 180);
    std::sort(sines.begin(), sines.end());
    if (sines[1] < 1.1 * sines[0]) continue;
    Point gradient;
    const double h = 1e-6;
    for (int k = 0; k < 3; ++k) {
      const Point step = h * Point::Unit(k);
      gradient[k] = (ball.worst(p + step) - ball.worst(p - step)) / (2 * h);
    }
    const Point before = p;
    const double reached = ball.optimise(p, {.steps = 1, .enough = 1, .least_gain = 0});
    if (reached == start) continue;
    CHECK(reached > start);
    CHECK((p - before).normalized().dot(gradient.normalized()) == doctest::Approx(1).epsilon(1e-6));
    ++checked;
  }
  CHECK(checked > 50);
}

TEST_CASE("a single tet over an equilateral triangle becomes regular") {
  const Triangle t = {Point(1, 0, 0), Point(-0.5, std::sqrt(0.75), 0),
                      Point(-0.5, -std::sqrt(0.75), 0)};
  BallOptimiser ball;
  ball.add(t[0], t[1], t[2]);
  Point p(0.3, -0.2, -0.4);
  if (ball.worst(p) < 0) p.z() = -p.z();
  REQUIRE(ball.worst(p) > 0);
  const double reached = ball.optimise(p, kBallToTheEnd);
  CHECK(reached == doctest::Approx(kRegularSine).epsilon(0.01));
  CHECK(reached == ball.worst(p));
}

TEST_CASE("a vertex displaced in an octahedron comes back to the centre") {
  Random random(4);
  BallOptimiser ball;
  load(ball, octahedron_faces(1));
  const double optimum = ball.worst(Point::Zero());
  CHECK(optimum == doctest::Approx(std::sqrt(2.0 / 3)));
  for (int trial = 0; trial < 50; ++trial) {
    Point p = random.in_ball(0.5);
    const double reached = ball.optimise(p, kBallToTheEnd);
    CHECK(reached == doctest::Approx(optimum).epsilon(0.03));
    CHECK(p.norm() < 0.05);
  }
}

TEST_CASE("a vertex outside its ball finds the way in") {
  BallOptimiser ball;
  load(ball, octahedron_faces(1));
  Point p(0.5, 0.5, 0.4);
  REQUIRE(ball.worst(p) < 0);
  CHECK(ball.optimise(p, kBallToTheEnd) > 0.7);
}

TEST_CASE("the ascent never ends below its start and stops where it says") {
  Random random(5);
  BallOptimiser ball;
  for (int trial = 0; trial < 500; ++trial) {
    const auto triangles = random_ball(random, 0.7);
    load(ball, triangles);
    Point p = random.in_ball(1.2);
    const double start = ball.worst(p);
    BallOptimiser::Limits limits;
    limits.steps = 1 + trial % 12;
    const double reached = ball.optimise(p, limits);
    CHECK(reached >= start);
    CHECK(reached == ball.worst(p));
    CHECK(reached == doctest::Approx(direct_worst(triangles, p)).epsilon(1e-12));
  }
}

TEST_CASE("a vertex that is good enough stays where it is") {
  BallOptimiser ball;
  load(ball, octahedron_faces(1));
  Point p(0.01, 0.02, 0);
  const Point before = p;
  const double reached = ball.optimise(p, {.steps = 40, .enough = 0.6});
  CHECK(reached > 0.6);
  CHECK(p == before);
}

TEST_CASE("the ascent comes close to what a random search finds") {
  Random random(6);
  BallOptimiser ball;
  int close = 0;
  const int trials = 100;
  double lost = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto triangles = random_ball(random, 0.5);
    load(ball, triangles);
    Point p = random.in_ball(0.3);
    const double target = random_search(triangles, p, random);
    const double reached = ball.optimise(p, kBallToTheEnd);
    if (reached > target - 0.02) ++close;
    lost += std::max(0.0, target - reached);
  }
  MESSAGE(close, " of ", trials, " within 0.02, mean loss ", lost / trials);
  CHECK(close >= 90);
  CHECK(lost / trials < 0.01);
}

TEST_CASE("the outcome does not depend on the scale of the mesh") {
  Random random(7);
  for (int trial = 0; trial < 30; ++trial) {
    const auto triangles = random_ball(random, 0.5);
    const Point start = random.in_ball(0.5);
    std::array<double, 3> reached{};
    std::array<Point, 3> places;
    constexpr std::array<double, 3> kScales = {1, 0x1p-20, 0x1p20};  // about 1e-6 and 1e6
    for (std::size_t s = 0; s < 3; ++s) {
      BallOptimiser ball;
      for (const Triangle& t : triangles) {
        ball.add(kScales[s] * t[0], kScales[s] * t[1], kScales[s] * t[2]);
      }
      Point p = kScales[s] * start;
      reached[s] = ball.optimise(p, {});
      places[s] = p / kScales[s];
    }
    for (const std::size_t s : {1u, 2u}) {  // powers of two: the same bits
      CHECK(reached[s] == reached[0]);
      CHECK(places[s] == places[0]);
    }
  }
}

TEST_CASE("degenerate triangles give quality 0 and no wrong numbers") {
  const Point a(1, 0, 0);
  const Point b(0, 1, 0);
  BallOptimiser ball;
  ball.add(a, a, b);               // two corners in one place
  ball.add(a, a, a);               // all in one place
  ball.add(a, b, 2 * b - a);       // on a line
  ball.add(a, b, Point(0, 0, 1));  // sound
  for (const Point& start : {Point(0, 0, 0), a, Point(0.5, 0.5, 0), Point(0, 0, -1)}) {
    Point p = start;
    const double before = ball.worst(p);
    const double reached = ball.optimise(p, kBallToTheEnd);
    CHECK(std::isfinite(reached));
    CHECK(p.allFinite());
    CHECK(reached >= before);
    for (std::size_t i = 0; i < 3; ++i) CHECK(ball.quality(i) == doctest::Approx(0));
  }
}

TEST_CASE("an empty ball has no worst tet and leaves the vertex alone") {
  BallOptimiser ball;
  Point p(1, 2, 3);
  CHECK(ball.worst(p) == std::numeric_limits<double>::infinity());
  ball.optimise(p, {});
  CHECK(p == Point(1, 2, 3));
  CHECK(ball.size() == 0);
}

TEST_CASE(
    "a ball of one tet that is flat, or whose vertex lies on a corner, is raised or left alone") {
  BallOptimiser ball;
  ball.add({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
  for (const Point& start : {Point(0.3, 0.3, 0), Point(0, 0, 0), Point(0.5, 0.5, 0)}) {
    Point p = start;
    const double reached = ball.optimise(p, kBallToTheEnd);
    CHECK(reached >= 0);
    CHECK(p.allFinite());
  }
  Point inside(0.3, 0.3, 0);
  CHECK(ball.optimise(inside, kBallToTheEnd) > 0.5);
}

TEST_CASE("the shortest vector in a hull is what enumeration finds") {
  Random random(8);
  for (int trial = 0; trial < 3000; ++trial) {
    const std::size_t n = 1 + random.index(7);
    std::vector<Point> points;
    const Point shift = random.in_ball(1.5);
    for (std::size_t i = 0; i < n; ++i) {
      points.push_back(shift + random.in_ball(1));
      if (trial % 5 == 1 && i > 0) points[i] = points[random.index(i)];  // repeated
      if (trial % 5 == 2) points[i].z() = 0;                             // in a plane through 0
      if (trial % 5 == 3) points[i] = points[0] * (1 + random.real());   // on a ray
    }
    const Point x = shortest_in_hull(points.data(), static_cast<unsigned>(n));
    const Point expected = shortest_by_enumeration(points);
    CAPTURE(trial);
    CHECK((x - expected).norm() < 1e-3);
    CHECK(x.norm() == doctest::Approx(expected.norm()).epsilon(1e-5));
    // No point lies noticeably behind the plane through x.
    for (const Point& p : points) CHECK(x.dot(p) >= x.squaredNorm() * (1 - 1e-5) - 1e-12);
  }
}

TEST_CASE("the hull around the origin has the shortest vector zero") {
  const std::array<Point, 4> corners = {Point(1, 1, 1), Point(-1, -1, 1), Point(-1, 1, -1),
                                        Point(1, -1, -1)};
  CHECK(shortest_in_hull(corners.data(), 4).norm() < 1e-12);
  const std::array<Point, 2> opposite = {Point(1, 2, 3), Point(-2, -4, -6)};
  CHECK(shortest_in_hull(opposite.data(), 2).norm() < 1e-12);
  const Point zero = Point::Zero();
  CHECK(shortest_in_hull(&zero, 1) == zero);
}
