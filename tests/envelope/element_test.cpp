// SPDX-License-Identifier: MIT
#include "envelope/element.h"

#include <vector>

#include <doctest/doctest.h>

#include "contract/zoo.h"
#include "tests/support/surface_distance.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

Point anywhere(contract::Random& random, double size) {
  return {random.real(-size, size), random.real(-size, size), random.real(-size, size)};
}

}  // namespace

TEST_CASE("the nearest point of a triangle is as near as its plane and sides say") {
  contract::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    Triangle t = {anywhere(random, 1), anywhere(random, 1), anywhere(random, 1)};
    if (i % 5 == 0) t[2] = t[0] + 1e-6 * (t[2] - t[0]);  // thin
    if (i % 50 == 0) t[2] = t[1];
    const Point p = anywhere(random, 2);
    const Point q = nearest_point(t, 3, p);
    CHECK((p - q).norm() == doctest::Approx(triangle_distance(p, t)).epsilon(1e-9));
    CHECK(triangle_distance(q, t) < 1e-9);
    const Point r = nearest_point({t[0], t[1], t[1]}, 2, p);
    CHECK((p - r).norm() == doctest::Approx(segment_distance(p, t[0], t[1])));
  }
}

TEST_CASE("a point of a needle is its own nearest point") {
  contract::Random random(3);
  const Triangle t = {Point(52176.19978596054, 0, 0), Point(68073.821973886923, 1, 0),
                      Point(102110.73296083038, 1, 0)};  // 50,000 times as long as high
  for (int i = 0; i < 2000; ++i) {
    const double s = random.real(0, 1);
    const double u = random.real(0, 1 - s);
    const Point p = t[0] + s * (t[1] - t[0]) + u * (t[2] - t[0]);
    CHECK((nearest_point(t, 3, p) - p).norm() < 1e-9);
    const Point above = p + Point(0, 0, 0.01);
    CHECK((nearest_point(t, 3, above) - p).norm() < 1e-9);
  }
}

TEST_CASE("the tree finds what a loop over the elements of a sheet finds") {
  contract::Random random(2);
  std::vector<Element> elements;
  std::vector<std::uint32_t> sheet_of;
  for (int i = 0; i < 300; ++i) {
    Element element;
    const Point p = anywhere(random, 1);
    element.points = {p, p + anywhere(random, 0.2), p + anywhere(random, 0.2)};
    element.sheet = static_cast<std::uint32_t>(random.index(4));
    element.tolerance = random.real(0, 0.1);
    sheet_of.push_back(element.sheet);
    elements.push_back(element);
  }
  const ElementTree tree(elements, sheet_of, 5);  // the last sheet has none
  for (int i = 0; i < 500; ++i) {
    const Point p = anywhere(random, 1.5);
    const auto sheet = static_cast<std::uint32_t>(random.index(4));
    double least = 1e9;
    std::vector<std::uint32_t> near;
    const Box box(p, p + Point(0.3, 0.4, 0.5));
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
      if (elements[e].sheet != sheet) continue;
      least = std::min(least, triangle_distance(p, elements[e].points));
      if (box_around(elements[e]).intersects(box)) near.push_back(e);
    }
    const auto found = tree.nearest(elements, sheet, p);
    CHECK(std::sqrt(found.distance2) == doctest::Approx(least).epsilon(1e-9));
    CHECK(elements[found.element].sheet == sheet);
    std::vector<std::uint32_t> listed;
    tree.find(elements, sheet, box, listed);
    CHECK(listed == near);
  }
  std::vector<std::uint32_t> none;
  tree.find(elements, 4, Box(Point(-9, -9, -9), Point(9, 9, 9)), none);
  CHECK(none.empty());
}
