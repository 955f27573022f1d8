// SPDX-License-Identifier: MIT
#include "viewer/mesh/polygon.h"

#include <algorithm>

#include <doctest/doctest.h>

using namespace tetmend::viewer;

namespace {

double polygon_area(const Polygon& polygon, const glm::dvec3& normal) {
  glm::dvec3 sum(0);
  for (unsigned i = 1; i + 1 < polygon.size; ++i) {
    sum += glm::cross(polygon.corners[i] - polygon.corners[0],
                      polygon.corners[i + 1] - polygon.corners[0]);
  }
  return glm::dot(sum, normal) / 2;
}

Polygon square() {
  Polygon polygon;
  for (const glm::dvec3& p :
       {glm::dvec3(0, 0, 0), glm::dvec3(2, 0, 0), glm::dvec3(2, 2, 0), glm::dvec3(0, 2, 0)}) {
    polygon.add(p, true);
  }
  return polygon;
}

constexpr std::array<glm::dvec3, 4> kTet = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

}  // namespace

TEST_CASE("a square cut in half keeps half its area and marks the new side") {
  const Polygon half = clip(square(), {{1, 0, 0}, 1}, false);
  REQUIRE(half.size == 4);
  CHECK(polygon_area(half, {0, 0, 1}) == doctest::Approx(2));
  CHECK(std::count(half.drawn.begin(), half.drawn.begin() + half.size, false) == 1);
}

TEST_CASE("a plane beside a polygon takes all or nothing") {
  CHECK(clip(square(), {{1, 0, 0}, 5}, true).size == 4);
  CHECK(clip(square(), {{1, 0, 0}, -1}, true).size == 0);
}

TEST_CASE("a plane between one corner and three cuts a tet in a triangle") {
  const Polygon section = cross_section(kTet, {{0, 0, 1}, 0.5});
  REQUIRE(section.size == 3);
  CHECK(polygon_area(section, {0, 0, 1}) == doctest::Approx(0.125));
  const Polygon other = cross_section(kTet, {{0, 0, -1}, -0.5});
  REQUIRE(other.size == 3);
  CHECK(polygon_area(other, {0, 0, -1}) == doctest::Approx(0.125));
}

TEST_CASE("a plane between two corners and two cuts a tet in a quadrilateral") {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 1, 0));
  const Polygon section = cross_section(kTet, {normal, 0.25 * glm::length(glm::dvec3(1, 1, 0))});
  REQUIRE(section.size == 4);
  // x + y = 1/2: sides from (1/2, 0) to (0, 1/2), height 1/2.
  CHECK(polygon_area(section, normal) == doctest::Approx(0.5 * std::sqrt(0.5)));
}

TEST_CASE("a plane beside a tet has no cross-section") {
  CHECK(cross_section(kTet, {{0, 0, 1}, 2}).size == 0);
  CHECK(cross_section(kTet, {{0, 0, 1}, -1}).size == 0);
}
