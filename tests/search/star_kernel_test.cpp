// SPDX-License-Identifier: MIT
#include "search/star_kernel.h"

#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/geometry.h"
#include "tests/support/tets.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Of an octahedron around 0, each seen counterclockwise from inside; its top is where it is told.
std::vector<Triangle> octahedron_with_top(const Point& top) {
  const std::array<Point, 4> ring = {Point(1, 0, 0), Point(0, 1, 0), Point(-1, 0, 0),
                                     Point(0, -1, 0)};
  const Point bottom(0, 0, -1);
  std::vector<Triangle> faces;
  for (std::size_t i = 0; i < 4; ++i) {
    const Point& a = ring[i];
    const Point& b = ring[(i + 1) % 4];
    faces.push_back({b, a, top});
    faces.push_back({a, b, bottom});
  }
  return faces;
}

bool sees_all(const std::vector<Triangle>& faces, const Point& p) {
  for (const auto& [a, b, c] : faces) {
    if (!(volume6(a, b, c, p) > 0)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("an octahedron has a kernel until its top is pushed through the bottom") {
  CHECK(has_kernel(octahedron_with_top({0, 0, 1})));
  REQUIRE(sees_all(octahedron_with_top({0, 0, 1}), {0, 0, 0}));
  CHECK(has_kernel(octahedron_with_top({0.05, 0.03, -0.5})));
  REQUIRE(sees_all(octahedron_with_top({0.05, 0.03, -0.5}), {0, 0, -0.7}));
  CHECK_FALSE(has_kernel(octahedron_with_top({0, 0, -1})));
  CHECK_FALSE(has_kernel(octahedron_with_top({0, 0, -1.5})));
  CHECK_FALSE(has_kernel(octahedron_with_top({3, 0, -1.5})));
}

TEST_CASE("a polyhedron turned inside out has no kernel") {
  std::vector<Triangle> faces = octahedron_with_top({0, 0, 1});
  for (auto& [a, b, c] : faces) std::swap(a, b);
  CHECK_FALSE(has_kernel(faces));
}

TEST_CASE("size and place do not matter, and a flat face has no inside") {
  for (const double size : {1e-9, 1e12}) {
    std::vector<Triangle> faces = octahedron_with_top({0.05, 0.03, -0.5});
    for (Triangle& face : faces) {
      for (Point& p : face) p = size * (p + Point(100, 200, -50));
    }
    CHECK(has_kernel(faces));
  }
  std::vector<Triangle> flat = octahedron_with_top({0, 0, 1});
  flat[0][1] = flat[0][0];
  CHECK_FALSE(has_kernel(flat));
  CHECK(has_kernel({}));
}

TEST_CASE("where random places see all faces, there is a kernel") {
  Random random(7);
  int seen = 0;
  int without = 0;
  for (int n = 0; n < 300; ++n) {
    std::vector<Triangle> faces = octahedron_with_top(random.in_ball(1.5));
    bool found = false;
    for (int k = 0; k < 2000 && !found; ++k) found = sees_all(faces, random.in_ball(1.5));
    seen += found ? 1 : 0;
    if (found) CHECK(has_kernel(faces));
    without += has_kernel(faces) ? 0 : 1;
  }
  CHECK(seen > 100);
  CHECK(without > 10);
}
