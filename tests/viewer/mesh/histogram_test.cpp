// SPDX-License-Identifier: MIT
#include "viewer/mesh/histogram.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace tetmend::viewer;

TEST_CASE("values outside of the range count at its ends, those of deleted tets nowhere") {
  const std::vector<float> values = {-5, 0, 0.5F, 1, 7, std::nanf("")};
  const Histogram histogram(values, {0, 1});
  CHECK(histogram.total() == 5);
  CHECK(histogram.counts().front() == 2);
  CHECK(histogram.counts()[Histogram::kBins / 2] == 1);
  CHECK(histogram.counts().back() == 2);
}

TEST_CASE("one tet beside a million has a bar that can be seen") {
  std::vector<float> values(1000000, 0.905F);
  values.push_back(0);
  const Histogram histogram(values, {0, 1});
  CHECK(histogram.bar(0) > 0.04);
  CHECK(histogram.bar(10) == 0);
  CHECK(histogram.bar(72) == doctest::Approx(1));
}

TEST_CASE("a brush gives a range in either direction, and its ends reach beyond the picture") {
  const Histogram histogram(std::vector<float>{1, 2}, {0, 2});
  CHECK(histogram.brushed(0.25, 0.5) == Range{0.5, 1});
  CHECK(histogram.brushed(0.5, 0.25) == Range{0.5, 1});
  CHECK(histogram.brushed(-0.1, 0.5).contains(-1000));
  CHECK(histogram.brushed(0.5, 1).contains(1000));
}
