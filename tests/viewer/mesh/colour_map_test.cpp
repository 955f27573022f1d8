// SPDX-License-Identifier: MIT
#include "viewer/mesh/colour_map.h"

#include <cmath>

#include <doctest/doctest.h>

#include "kernel/error.h"

using namespace tetmend;
using namespace tetmend::viewer;

TEST_CASE("a map starts and ends with its first and last colour, also beyond its ends") {
  for (const ColourMap& map : colour_maps()) {
    CAPTURE(map.name);
    CHECK(map.at(0) == map.stops.front());
    CHECK(map.at(-3) == map.stops.front());
    CHECK(map.at(std::nan("")) == map.stops.front());
    CHECK(map.at(1) == map.stops.back());
    CHECK(map.at(9) == map.stops.back());
    CHECK(map.at(0.5) != map.stops.front());
  }
}

TEST_CASE("an unknown map is refused with the valid ones") {
  CHECK(find_colour_map("dusk").name == "dusk");
  CHECK_THROWS_WITH_AS(find_colour_map("rainbow"), doctest::Contains("ember, dusk, grey"), Error);
}

TEST_CASE("neighbouring regions have different colours") {
  for (Label label = -3; label < 20; ++label) {
    CHECK(region_colour(label) != region_colour(label + 1));
  }
}
