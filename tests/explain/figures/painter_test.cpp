// SPDX-License-Identifier: MIT
#include "explain/figures/painter.h"

#include <algorithm>

#include <doctest/doctest.h>

using namespace tetmend;
using namespace tetmend::explain;

namespace {

TetCorners tet_at(const Point& p, double size = 1) {
  return {p, p + size * Point(1, 0, 0), p + size * Point(0, 1, 0), p + size * Point(0, 0, 1)};
}

std::size_t rank(const std::vector<std::size_t>& order, std::size_t i) {
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), i) - order.begin());
}

}  // namespace

TEST_CASE("the far tet is painted first, from both sides") {
  const std::vector<TetCorners> tets = {tet_at({0, 0, 0}), tet_at({0, 0, 5}), tet_at({0, 0, -5})};
  CHECK(paint_order(tets, {0, 0, -1}) == std::vector<std::size_t>{2, 0, 1});
  CHECK(paint_order(tets, {0, 0, 1}) == std::vector<std::size_t>{1, 0, 2});
}

TEST_CASE("a plane between two tets decides, although their centres say otherwise") {
  // Seen from above, a long tet slopes down to the right. Its centre is far below the small one,
  // but at its upper end it covers it.
  const TetCorners slope = {Point(-10, -1, 1), Point(-10, 1, 1), Point(10, 0, -9),
                            Point(-10, 0, 1.1)};
  const TetCorners small = tet_at({-9.5, -0.1, 0}, 0.2);
  for (const Point& forward : {Point(0, 0, -1), Point(0, 0, 1)}) {
    const bool from_above = forward.z() < 0;
    const std::vector<TetCorners> tets = {small, slope};
    const auto order = paint_order(tets, forward);
    CHECK((rank(order, 0) < rank(order, 1)) == from_above);
    const std::vector<TetCorners> turned = {slope, small};
    const auto back = paint_order(turned, forward);
    CHECK((rank(back, 1) < rank(back, 0)) == from_above);
  }
}

TEST_CASE("each tet is painted once, also of none") {
  CHECK(paint_order({}, {0, 0, 1}).empty());
  std::vector<TetCorners> tets;
  for (int i = 0; i < 20; ++i) tets.push_back(tet_at({1.5 * (i % 5), 1.5 * (i / 5), 0.1 * i}));
  auto order = paint_order(tets, Point(1, 2, 3).normalized());
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) CHECK(order[i] == i);
  CHECK(order.size() == 20);
}
