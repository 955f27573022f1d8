// SPDX-License-Identifier: MIT
// Derivatives against differences; patches of known solution, and one without.
#include "search/untangler.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/geometry.h"
#include "kernel/quality.h"
#include "tests/support/tets.h"
#include "tests/support/threads.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const auto kEachStep = [](std::size_t) { return true; };

/// A cube of cells^3 cells whose inner vertices are moved by up to `jitter` cells.
TangledPatch cube_patch(unsigned cells, double jitter, std::uint64_t seed) {
  const MeshData data = kuhn_cube(cells, jitter, seed);
  const auto is_inner = [](const Point& rest) {
    return rest.minCoeff() > 1e-9 && rest.maxCoeff() < 1 - 1e-9;
  };
  const MeshData at_rest = kuhn_cube(cells, 0, seed);
  std::vector<std::uint32_t> number(data.points.size());
  TangledPatch patch;
  for (const bool inner : {true, false}) {
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (is_inner(at_rest.points[v]) != inner) continue;
      number[v] = static_cast<std::uint32_t>(patch.points.size());
      patch.points.push_back(data.points[v]);
    }
    if (inner) patch.free_count = patch.points.size();
  }
  for (const MeshData::Tet& tet : data.tets) {
    const auto& v = tet.vertices;
    patch.tets.push_back({number[v[0]], number[v[1]], number[v[2]], number[v[3]]});
  }
  return patch;
}

std::size_t count_inverted_of(const TangledPatch& patch, std::span<const Point> points) {
  return static_cast<std::size_t>(
      std::count_if(patch.tets.begin(), patch.tets.end(), [&](const auto& v) {
        return !certified_positive(points[v[0]], points[v[1]], points[v[2]], points[v[3]]);
      }));
}

double share(const TangledPatch& patch) {
  return static_cast<double>(count_inverted_of(patch, patch.points)) /
         static_cast<double>(patch.tets.size());
}

bool stayed(const TangledPatch& patch, std::span<const Point> points) {
  return std::equal(patch.points.begin() + static_cast<std::ptrdiff_t>(patch.free_count),
                    patch.points.end(),
                    points.begin() + static_cast<std::ptrdiff_t>(patch.free_count), points.end());
}

}  // namespace

TEST_CASE("the gradient of a tangled tet is that of differences, whatever its sign") {
  Random random(3);
  constexpr double kStep = 1e-6;
  for (int n = 0; n < 200; ++n) {
    TetPoints p;
    for (Point& corner : p) corner = random.in_ball(1);
    const double size = random.real(0.5, 2);
    for (const double softness : {2.0, 0.3, 0.1}) {
      TetPoints gradient;
      TangledTet(p, size).gradient(softness, gradient);
      for (std::size_t i = 0; i < 4; ++i) {
        for (Eigen::Index k = 0; k < 3; ++k) {
          TetPoints ahead = p;
          TetPoints behind = p;
          ahead[i][k] += kStep;
          behind[i][k] -= kStep;
          const double slope =
              (TangledTet(ahead, size).cost(softness) - TangledTet(behind, size).cost(softness)) /
              (2 * kStep);
          CHECK(gradient[i][k] == doctest::Approx(slope).epsilon(1e-5).scale(1));
        }
      }
    }
  }
}

TEST_CASE(
    "a tet of the right shape and size costs least, and without softness as by its mean ratio") {
  const TetPoints right = regular_tet(0.7);
  CHECK(TangledTet(right, 0.7).volume() == doctest::Approx(1));
  CHECK(TangledTet(right, 0.7).cost(1e-9) == doctest::Approx(1));
  TetPoints gradient;
  TangledTet(right, 0.7).gradient(1e-9, gradient);
  for (const Point& g : gradient) CHECK(g.norm() < 1e-9);
  Random random(5);
  for (int n = 0; n < 50; ++n) {
    TetPoints p = right;
    for (Point& corner : p) corner += random.in_ball(0.2);
    const TangledTet tet(p, 0.7);
    CHECK(tet.cost(1e-9) > 1);
    const double by_shape = 1 / mean_ratio(p[0], p[1], p[2], p[3]);
    const double by_volume = (tet.volume() * tet.volume() + 1) / (2 * tet.volume());
    const double least = std::min(by_shape, by_volume);
    const double most = std::max(by_shape, by_volume);
    CHECK(tet.cost(1e-9) >= least - 1e-9);
    CHECK(tet.cost(1e-9) <= most + 1e-9);
    std::swap(p[0], p[1]);
    CHECK(TangledTet(p, 0.7).volume() == doctest::Approx(-tet.volume()));
    CHECK(std::isfinite(TangledTet(p, 0.7).cost(0.1)));
  }
}

TEST_CASE("cubes with up to 45 percent of inverted tets are untangled, and fixed points stay") {
  double least = 1;
  double most = 0;
  for (const double jitter : {0.7, 1.0, 1.5, 3.0, 20.0}) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      CAPTURE(jitter);
      CAPTURE(seed);
      const TangledPatch patch = cube_patch(6, jitter, seed);
      least = std::min(least, share(patch));
      most = std::max(most, share(patch));
      Untangler untangler(patch);
      CHECK(untangler.untangle({}, kEachStep) == 0);
      CHECK(count_inverted_of(patch, untangler.points()) == 0);
      CHECK(stayed(patch, untangler.points()));
      CHECK(untangler.looks() < 150);
    }
  }
  CHECK(least < 0.12);
  CHECK(most > 0.44);
}

TEST_CASE("a patch that is far from 0 and of another size is untangled just so") {
  TangledPatch patch = cube_patch(5, 1.5, 4);
  for (Point& p : patch.points) p = 1e-3 * p + Point(10, -20, 30);
  Untangler untangler(patch);
  CHECK(untangler.untangle({}, kEachStep) == 0);
  CHECK(count_inverted_of(patch, untangler.points()) == 0);
}

TEST_CASE("the number of threads does not show in an untangled patch") {
  const TangledPatch patch = cube_patch(15, 1.8, 1);
  REQUIRE(patch.tets.size() > 20000);
  std::vector<Point> first;
  for (const int threads : {1, 2, 3, 8}) {
    on_threads(threads, [&] {
      Untangler untangler(patch);
      CHECK(untangler.untangle({}, kEachStep) == 0);
      const std::vector<Point> points(untangler.points().begin(), untangler.points().end());
      if (first.empty()) first = points;
      CHECK(points == first);
    });
  }
}

TEST_CASE("tets that cannot be positive do not hold back the others") {
  TangledPatch patch = cube_patch(6, 1.5, 2);
  // Two fixed points in the middle whose tets with fixed points are turned over: where one is.
  const auto v = static_cast<std::uint32_t>(patch.points.size());
  const Point at = patch.points[0];
  patch.points.insert(patch.points.end(),
                      {at + Point(0, 0, 0.3), at + Point(0.3, 0, 0.3), at + Point(0, 0.3, 0.3)});
  patch.tets.push_back({0, v, v + 1, v + 2});
  patch.tets.push_back({0, v, v + 2, v + 1});
  Untangler untangler(patch);
  CHECK(untangler.untangle({}, kEachStep) == 1);
  CHECK(count_inverted_of(patch, untangler.points()) == 1);
}

TEST_CASE("an untangler looks as often as it may, and never ends with more inverted tets") {
  // One vertex is so far away that the cost is very soft at first, and others lose their places.
  TangledPatch patch = cube_patch(6, 0.3, 1);
  patch.points[62] += Point(20, 20, 20);
  const std::size_t before = count_inverted_of(patch, patch.points);
  for (unsigned looks = 1; looks < 40; ++looks) {
    Untangler hurried(patch);
    hurried.untangle({.looks = looks}, kEachStep);
    CHECK(hurried.looks() < looks + 15);
    CHECK(count_inverted_of(patch, hurried.points()) <= before);
  }
}

TEST_CASE("an untangler that is stopped in a look ends with what it had") {
  const TangledPatch patch = cube_patch(8, 1.5, 1);
  const std::size_t before = count_inverted_of(patch, patch.points);
  for (const int most : {1, 2, 3, 20, 41}) {
    CAPTURE(most);
    Untangler stopped(patch);
    std::atomic<int> asked = 0;
    stopped.untangle({}, [&](std::size_t) { return ++asked < most; });
    CHECK(asked >= most);
    CHECK(asked < most + 3);  // each part of a look asks once
    CHECK(count_inverted_of(patch, stopped.points()) <= before);
  }
}

TEST_CASE("a patch without free vertices, or without tets, is as it was") {
  TangledPatch patch = cube_patch(3, 2, 1);
  patch.free_count = 0;
  Untangler untangler(patch);
  CHECK(untangler.untangle({}, kEachStep) == count_inverted_of(patch, patch.points));
  CHECK(std::equal(patch.points.begin(), patch.points.end(), untangler.points().begin()));
  Untangler nothing({});
  CHECK(nothing.untangle({}, kEachStep) == 0);
}
