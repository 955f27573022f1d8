// SPDX-License-Identifier: MIT
#include "kernel/hilbert.h"

#include <algorithm>
#include <set>
#include <vector>

#include <doctest/doctest.h>

using namespace tetmend;

namespace {

/// Centres of the cells of a cube of n cells a side, between two corners that span the curve.
std::vector<Point> cell_centres(int n) {
  std::vector<Point> centres;
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < n; ++y) {
      for (int z = 0; z < n; ++z) centres.emplace_back(x + 0.5, y + 0.5, z + 0.5);
    }
  }
  return centres;
}

}  // namespace

TEST_CASE("cells that follow each other along the curve share a face, at every level") {
  for (const int n : {2, 4, 16}) {
    CAPTURE(n);
    const std::vector<Point> corners = {Point::Zero(), Point::Constant(n)};
    const HilbertCurve curve(corners);
    std::vector<Point> cells = cell_centres(n);
    std::sort(cells.begin(), cells.end(),
              [&](const Point& p, const Point& q) { return curve.key(p) < curve.key(q); });
    for (std::size_t i = 1; i < cells.size(); ++i) {
      REQUIRE((cells[i] - cells[i - 1]).lpNorm<1>() == doctest::Approx(1));
    }
  }
}

TEST_CASE("each cell of the finest level has a key of its own below 2^63") {
  constexpr double kCells = 1 << 21;
  const std::vector<Point> corners = {Point::Zero(), Point::Constant(kCells - 1)};
  const HilbertCurve curve(corners);
  std::set<std::uint64_t> keys;
  for (const double at : {0.0, 1.0, 2.0, 1048575.0, 1048576.0, kCells - 2, kCells - 1}) {
    for (const Point& cell : {Point(at, 0, 0), Point(0, at, 3), Point(5, 2, at), Point(at, at, at)})
      keys.insert(curve.key(cell));
  }
  CHECK(keys.size() == 27);  // the origin comes twice
  CHECK(*keys.begin() == 0);
  CHECK(*keys.rbegin() < std::uint64_t{1} << 63);
}
