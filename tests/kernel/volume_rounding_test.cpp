// SPDX-License-Identifier: MIT
#include "kernel/volume_rounding.h"

#include <vector>

#include <doctest/doctest.h>

using namespace tetmend;

TEST_CASE("a volume that changes is no rounding, but for what a thin mesh cannot tell") {
  const auto one = [] { return 1.0; };
  CHECK(is_rounding(0, 1, one));
  CHECK(is_rounding(9e-10, 1, one));
  CHECK(!is_rounding(1e-8, 1, one));
  CHECK(!is_rounding(1e-8, 1e-5, one));
  CHECK(is_rounding(1e-8, 1e-7, one));  // its sides are 1
  CHECK(!is_rounding(1e-3, 1e-7, one));
  CHECK(!is_rounding(1e-8, 1e-7, [] { return 0.1; }));
  CHECK(!is_rounding(std::numeric_limits<double>::quiet_NaN(), 1, one));
}

TEST_CASE("the longest side is that of the box around the points") {
  const std::vector<Point> points = {Point(1, 2, 3), Point(-1, 2, 8), Point(0, 0, 3)};
  CHECK(longest_side(points) == 5);
  CHECK(longest_side({}) == 0);
}
