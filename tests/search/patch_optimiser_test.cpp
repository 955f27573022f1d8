// SPDX-License-Identifier: MIT
// The placement of several vertices at once, against finite differences and the ascent of one
// vertex.
#include "search/patch_optimiser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/geometry.h"
#include "kernel/judge.h"
#include "search/ball_optimiser.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

constexpr PatchOptimiser::Limits kPatchToTheEnd = {.steps = 300, .enough = 0.9, .least_gain = 1e-9};

/// Points and tets; the first `free` points may move.
struct Patch {
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 4>> tets;
  std::size_t free = 1;

  double quality(std::size_t t, const std::vector<Point>& at) const {
    const auto& [a, b, c, d] = tets[t];
    return minimum_sine(at[a], at[b], at[c], at[d]);
  }
  double worst(const std::vector<Point>& at) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < tets.size(); ++t) least = std::min(least, quality(t, at));
    return least;
  }
  void load(PatchOptimiser& patch) const {
    patch.clear(Standard());
    for (std::size_t v = 0; v < free; ++v) patch.add_vertex(points[v]);
    for (const auto& tet : tets) {
      std::array<Point, 4> corners;
      std::array<int, 4> vertex{};
      for (unsigned i = 0; i < 4; ++i) {
        corners[i] = points[tet[i]];
        vertex[i] = tet[i] < free ? static_cast<int>(tet[i]) : PatchOptimiser::kFixed;
      }
      patch.add_tet(corners, vertex);
    }
  }
  std::vector<Point> moved(const PatchOptimiser& patch) const {
    std::vector<Point> at = points;
    for (std::size_t v = 0; v < free; ++v) at[v] = patch.point(v);
    return at;
  }
};

/// Two vertices, 0 and 1, in a double pyramid over a ring of six whose points are moved at random.
Patch random_patch(Random& random, double amount) {
  Patch patch;
  patch.points = {{0, 0, -0.5}, {0, 0, 0.5}, {0, 0, -1.6}, {0, 0, 1.6}};
  for (int i = 0; i < 6; ++i) {
    const double angle = i * std::numbers::pi / 3;
    patch.points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  for (Point& p : patch.points) p += random.in_ball(amount);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t p = 4 + i;
    const std::size_t q = 4 + (i + 1) % 6;
    patch.tets.push_back({2, 0, p, q});
    patch.tets.push_back({0, 1, p, q});
    patch.tets.push_back({1, 3, p, q});
  }
  patch.free = 2;
  return patch;
}

}  // namespace

TEST_CASE("the worst of a patch is its smallest minimum sine, also with inverted tets") {
  Random random(1);
  PatchOptimiser optimiser;
  for (int trial = 0; trial < 100; ++trial) {
    const Patch patch = random_patch(random, 0.6);
    patch.load(optimiser);
    REQUIRE(optimiser.tet_count() == 18);
    REQUIRE(optimiser.vertex_count() == 2);
    CHECK(optimiser.worst() == doctest::Approx(patch.worst(patch.points)).epsilon(1e-12));
    double sum = 0;
    for (std::size_t t = 0; t < 18; ++t) sum += deficit(patch.quality(t, patch.points));
    CHECK(optimiser.total_deficit() == doctest::Approx(sum).epsilon(1e-12));
  }
}

TEST_CASE("the first step goes down the gradient of the norm found by finite differences") {
  Random random(2);
  PatchOptimiser optimiser;
  constexpr double kEnough = 0.6;
  const auto norm = [](const Patch& patch, const std::vector<Point>& at) {
    double sum = 0;
    for (const auto& [a, b, c, d] : patch.tets) {
      for (const double angle : dihedral_angles(at[a], at[b], at[c], at[d])) {
        const double lack = kEnough - std::sin(angle * std::numbers::pi / 180);
        if (lack > 0) sum += std::pow(lack, 4);
      }
    }
    return std::pow(sum, 0.25);
  };
  int checked = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Patch patch = random_patch(random, 0.3);
    if (patch.worst(patch.points) < 0.05) continue;
    patch.load(optimiser);
    optimiser.optimise(
        {.mildest = 2, .sharpest = 2, .steps = 1, .enough = kEnough, .least_gain = 0});
    const std::vector<Point> moved = patch.moved(optimiser);
    if (moved == patch.points) continue;  // the worst tet is no better there
    // Each vertex has a unit of its own, the mean length of its edges.
    std::array<Point, 2> downhill;
    std::array<Point, 2> step;
    for (std::size_t v = 0; v < 2; ++v) {
      double edges = 0;
      double length = 0;
      for (const auto& tet : patch.tets) {
        if (std::find(tet.begin(), tet.end(), v) == tet.end()) continue;
        for (const std::size_t w : tet) {
          length += (patch.points[w] - patch.points[v]).norm();
          edges += w != v;
        }
      }
      for (int k = 0; k < 3; ++k) {
        constexpr double kStep = 1e-6;
        std::vector<Point> to = patch.points;
        to[v][k] += kStep;
        downhill[v][k] = -norm(patch, to);
        to[v][k] -= 2 * kStep;
        downhill[v][k] = (downhill[v][k] + norm(patch, to)) / (2 * kStep) * (length / edges);
      }
      step[v] = (moved[v] - patch.points[v]) / (length / edges);
    }
    const std::size_t more = step[0].norm() > step[1].norm() ? 0 : 1;
    const double length = step[more].norm();
    const double factor = length / downhill[more].norm();
    for (std::size_t v = 0; v < 2; ++v) {
      CHECK((step[v] - factor * downhill[v]).norm() < 1e-5 * length);
    }
    ++checked;
  }
  CHECK(checked > 50);
}

TEST_CASE("a single vertex comes as far as by the ascent of its ball") {
  Random random(3);
  PatchOptimiser optimiser;
  int close = 0;
  const int trials = 100;
  for (int trial = 0; trial < trials; ++trial) {
    Patch patch = random_patch(random, 0.25);
    patch.free = 1;
    std::erase_if(patch.tets, [](const auto& tet) {
      return std::find(tet.begin(), tet.end(), 0u) == tet.end();
    });
    patch.load(optimiser);
    BallOptimiser ball;
    for (const auto& tet : patch.tets) {
      const auto at = static_cast<std::size_t>(std::find(tet.begin(), tet.end(), 0u) - tet.begin());
      std::array<Point, 3> triangle;
      for (unsigned i = 0; i < 3; ++i) triangle[i] = patch.points[tet[kFaceVertices[at][i]]];
      ball.add(triangle[0], triangle[1], triangle[2]);
    }
    Point p = patch.points[0];
    if (!(ball.worst(p) > 0)) continue;
    const double alone =
        ball.optimise(p, {.steps = 1000, .enough = 1, .least_gain = 1e-9, .least_step = 1e-4});
    close += optimiser.optimise(kPatchToTheEnd) > alone - 0.01;
  }
  MESSAGE(close, " of ", trials, " as good as the ascent");
  CHECK(close > 90);
}

TEST_CASE("two vertices get further together than in turns") {
  Random random(4);
  PatchOptimiser optimiser;
  double gained = 0;
  int further = 0;
  int trials = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Patch patch = random_patch(random, 0.3);
    if (!(patch.worst(patch.points) > 0)) continue;
    ++trials;
    Patch in_turns = patch;
    for (int turn = 0; turn < 40; ++turn) {
      std::swap(in_turns.points[0], in_turns.points[1]);
      for (auto& tet : in_turns.tets) {
        for (std::size_t& v : tet) v = v < 2 ? 1 - v : v;
      }
      in_turns.free = 1;
      in_turns.load(optimiser);
      optimiser.optimise(kPatchToTheEnd);
      in_turns.points = in_turns.moved(optimiser);
    }
    patch.load(optimiser);
    const double together = optimiser.optimise(kPatchToTheEnd);
    const double alone = in_turns.worst(in_turns.points);
    gained += together - alone;
    further += together > alone + 0.01;
  }
  MESSAGE(further, " of ", trials, " further together, on average by ", gained / trials);
  CHECK(further > trials / 4);
  CHECK(gained / trials > 0.005);
}

TEST_CASE("the worst never falls and no positive tet turns over") {
  Random random(5);
  PatchOptimiser optimiser;
  for (int trial = 0; trial < 300; ++trial) {
    const Patch patch = random_patch(random, 0.7);
    patch.load(optimiser);
    const double start = optimiser.worst();
    const double reached = optimiser.optimise({.steps = 1 + trial % 20});
    CHECK(reached >= start);
    const std::vector<Point> moved = patch.moved(optimiser);
    CHECK(reached == doctest::Approx(patch.worst(moved)).epsilon(1e-9));
    for (std::size_t t = 0; t < patch.tets.size(); ++t) {
      if (patch.quality(t, patch.points) > 1e-12) CHECK(patch.quality(t, moved) > 0);
    }
  }
}

TEST_CASE("where the places go does not depend on the scale of the mesh") {
  Random random(6);
  for (int trial = 0; trial < 30; ++trial) {
    const Patch patch = random_patch(random, 0.3);
    std::vector<std::vector<Point>> places;
    for (const double scale : {1.0, 0x1p-20, 0x1p20}) {  // powers of two: the same bits
      Patch scaled = patch;
      for (Point& p : scaled.points) p *= scale;
      PatchOptimiser optimiser;
      scaled.load(optimiser);
      optimiser.optimise({});
      places.push_back(scaled.moved(optimiser));
      for (Point& p : places.back()) p /= scale;
    }
    CHECK(places[1] == places[0]);
    CHECK(places[2] == places[0]);
  }
}

TEST_CASE("a patch that is good enough, or empty, stays as it is") {
  Random random(7);
  PatchOptimiser optimiser;
  const Patch patch = random_patch(random, 0);
  patch.load(optimiser);
  const double start = optimiser.worst();
  CHECK(optimiser.optimise({.enough = 0.5 * start}) == start);
  CHECK(patch.moved(optimiser) == patch.points);
  optimiser.clear(Standard());
  CHECK(optimiser.optimise({}) == std::numeric_limits<double>::infinity());
  CHECK(optimiser.total_deficit() == 0);
}

TEST_CASE("a tet is lifted to a goal only if no other falls below what it may") {
  Random random(21);
  constexpr double kLeast = 0.4;
  unsigned lifted = 0;
  unsigned refused = 0;
  for (int round = 0; round < 100; ++round) {
    const Patch patch = random_patch(random, 0.35);
    PatchOptimiser optimiser;
    patch.load(optimiser);
    std::vector<double> before;
    for (std::size_t t = 0; t < patch.tets.size(); ++t) {
      before.push_back(patch.quality(t, patch.points));
    }
    const auto worst = std::min_element(before.begin(), before.end());
    if (*worst <= 0) continue;
    const auto target = static_cast<std::size_t>(worst - before.begin());
    const double goal = *worst + (round % 2 == 0 ? 0.05 : 0.4);
    const bool reached = optimiser.lift(target, goal, kLeast, {.steps = 200, .least_gain = 1e-6});
    const std::vector<Point> after = patch.moved(optimiser);
    (reached ? lifted : refused) += 1;
    if (!reached) CHECK(after == patch.points);
    for (std::size_t t = 0; t < patch.tets.size() && reached; ++t) {
      CHECK(patch.quality(t, after) > std::min(before[t], kLeast) - 1e-5);
    }
  }
  MESSAGE(lifted, " lifted, ", refused, " refused");
  CHECK(lifted > 20);
  CHECK(refused > 5);
}

TEST_CASE("a lifted tet has its goal at the angles that are like its worst") {
  Random random(22);
  unsigned lifted = 0;
  for (int round = 0; round < 100; ++round) {
    const Patch patch = random_patch(random, 0.35);
    PatchOptimiser optimiser;
    patch.load(optimiser);
    if (patch.worst(patch.points) <= 0) continue;
    const std::size_t target = 1;  // between the two vertices that move
    const auto angles = [&](const std::vector<Point>& at) {
      const auto& [a, b, c, d] = patch.tets[target];
      return dihedral_angles(at[a], at[b], at[c], at[d]);
    };
    const auto sine = [](double degrees) { return std::sin(degrees * std::numbers::pi / 180); };
    const auto before = angles(patch.points);
    const double worst = *std::min_element(before.begin(), before.end(),
                                           [&](double x, double y) { return sine(x) < sine(y); });
    const double goal = patch.quality(target, patch.points) + 0.1;
    if (!optimiser.lift(target, goal, 0.1, {.steps = 200, .least_gain = 1e-6})) continue;
    ++lifted;
    const auto now = angles(patch.moved(optimiser));
    for (std::size_t e = 0; e < 6; ++e) {
      if ((before[e] > 90) == (worst > 90)) CHECK(sine(now[e]) > goal - 1e-5);
    }
  }
  MESSAGE(lifted, " lifted");
  CHECK(lifted > 20);
}

TEST_CASE("a degenerate tet counts as 0 and makes no wrong numbers") {
  PatchOptimiser optimiser;
  Patch patch;
  patch.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  patch.tets = {{0, 1, 2, 3}, {4, 0, 1, 2}, {0, 0, 1, 2}};
  patch.load(optimiser);
  CHECK(optimiser.worst() == 0);
  CHECK(optimiser.optimise({}) >= 0);
  CHECK(optimiser.point(0).allFinite());
}
