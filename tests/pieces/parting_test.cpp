// SPDX-License-Identifier: MIT
#include "pieces/parting.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "tests/pieces/meshes.h"

using namespace tetmend;
using namespace tetmend::pieces;

namespace {

Parting parting_of(const std::vector<Point>& points, std::size_t parts, unsigned shift) {
  Parting parting;
  parting.side = 20;
  parting.shift = shift;
  KeyHistogram histogram;
  const HilbertCurve curve = shifted_curve(parting.low, parting.side, shift);
  for (const Point& p : points) histogram.count(curve.key(p));
  histogram.refine(parts);
  for (const Point& p : points) histogram.count(curve.key(p));
  parting.cuts = histogram.cuts();
  return parting;
}

}  // namespace

TEST_CASE("parts have about the same number of points, for every shift") {
  const std::vector<Point> points = test::lattice(20).points;
  for (const unsigned shift : {0u, 1u, 2u}) {
    const Parting parting = parting_of(points, 8, shift);
    std::vector<std::size_t> counts(8, 0);
    for (const std::uint32_t part : parting.parts_of(points)) ++counts[part];
    for (const std::size_t count : counts) {
      CHECK(count > points.size() / 8 * 9 / 10);
      CHECK(count < points.size() / 8 * 11 / 10);
    }
  }
}

TEST_CASE("a cut is where the fine cell begins before which the share of a part is full") {
  std::vector<std::uint64_t> keys;
  std::uint64_t state = 5;
  for (int i = 0; i < 20'000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    keys.push_back(i % 3 == 0 ? (state >> 1) / 1000 : state >> 1);  // many are close to 0
  }
  std::vector<std::uint64_t> cells;
  for (const std::uint64_t key : keys) cells.push_back(key >> 42);
  std::sort(cells.begin(), cells.end());
  for (const std::size_t parts : {2, 3, 64, 5000}) {
    KeyHistogram histogram;
    for (const std::uint64_t key : keys) histogram.count(key);
    histogram.refine(parts);
    for (const std::uint64_t key : keys) histogram.count(key);
    const std::vector<std::uint64_t> cuts = histogram.cuts();
    REQUIRE(cuts.size() == parts);
    CHECK(cuts[0] == 0);
    for (std::size_t part = 1; part < parts; ++part) {
      const std::size_t least = (keys.size() * part + parts - 1) / parts;
      CHECK(cuts[part] == (cells[least - 1] + 1) << 42);
    }
  }
  KeyHistogram none;
  none.refine(4);
  CHECK(none.cuts() == std::vector<std::uint64_t>(4, 0));
}

TEST_CASE("a shelf gives some of its bytes, wherever they came in") {
  const test::Folder folder;
  MemoryShelf memory;
  FolderShelf files(folder.path());
  for (Shelf* shelf : {static_cast<Shelf*>(&memory), static_cast<Shelf*>(&files)}) {
    for (const char* part : {"abc", "", "defg", "h"}) shelf->append("x", part);
    CHECK(shelf->read("x") == "abcdefgh");
    CHECK(shelf->read("x", 0, 2) == "ab");
    CHECK(shelf->read("x", 2, 3) == "cde");
    CHECK(shelf->read("x", 3, 5) == "defgh");
    CHECK(shelf->read("x", 7, 9) == "h");
    CHECK(shelf->read("x", 8, 1) == "");
    CHECK(shelf->read("x", 20, 1) == "");
    CHECK(shelf->read("none", 1, 2) == "");
    shelf->put("x", "new");
    CHECK(shelf->read("x", 1, 9) == "ew");
  }
}

TEST_CASE("the order in which points are counted does not show; shifts do") {
  std::vector<Point> points = test::lattice(20).points;
  const Parting parting = parting_of(points, 5, 1);
  std::reverse(points.begin(), points.end());
  CHECK(parting_of(points, 5, 1).cuts == parting.cuts);
  CHECK(parting_of(points, 5, 2).parts_of(points) != parting.parts_of(points));
}

TEST_CASE("more parts than points: some are empty") {
  const std::vector<Point> points = {Point(1, 1, 1), Point(2, 2, 2)};
  const Parting parting = parting_of(points, 7, 0);
  CHECK(parting.cuts.size() == 7);
  CHECK(std::is_sorted(parting.cuts.begin(), parting.cuts.end()));
  for (const std::uint32_t part : parting.parts_of(points)) CHECK(part < 7);
}

TEST_CASE("balls that touch are one zone, numbered by its worst tet") {
  const std::vector<WorstTet> worst = {{0.1f, Point(0, 0, 0), 1},
                                       {0.2f, Point(100, 0, 0), 1},
                                       {0.3f, Point(6, 0, 0), 1},
                                       {0.4f, Point(12, 0, 0), 1}};
  const ZoneMap zones(worst);
  CHECK(zones.count() == 2);
  CHECK(zones.find(Point(0, 2.9, 0)) == 0);
  CHECK(zones.find(Point(12, 2.9, 0)) == 0);
  CHECK(zones.find(Point(100, 2.9, 0)) == 1);
  CHECK(zones.find(Point(50, 0, 0)) == -1);
  CHECK(zones.find(Point(0, 3.1, 0)) == -1);
}

TEST_CASE("a zone of too many points is cut: the worst ball stays with those nearest to it") {
  // Two heaps of balls that touch each other, and a ball far away.
  std::vector<WorstTet> worst = {{0.1f, Point(50, 0, 0), 1}};
  for (const double x : {0.0, 1.0, 2.0, 7.0, 8.0, 9.0}) worst.push_back({0.2f, Point(x, 0, 0), 1});
  std::vector<Point> points;
  for (const Point& p : test::lattice(12).points) points.emplace_back(2 * p - Point(6, 10, 10));
  for (const Point& p : test::lattice(2).points) points.emplace_back(p + Point(49, 0, 0));

  ZoneMap zones(worst);
  REQUIRE(zones.count() == 2);
  std::vector<std::int64_t> by_ball(zones.balls().size(), 0);
  zones.count(points, by_ball);
  const auto sizes = [&] {
    std::vector<std::int64_t> counts(zones.count(), 0);
    for (const Point& p : points) {
      if (const int zone = zones.find(p); zone >= 0) ++counts[static_cast<std::size_t>(zone)];
    }
    return counts;
  };
  const std::vector<std::int64_t> whole = sizes();
  CHECK(std::accumulate(by_ball.begin(), by_ball.end(), std::int64_t{0}) == whole[0] + whole[1]);

  const ZoneMap uncut = zones;
  zones.cut(by_ball, whole[1]);
  CHECK(zones.count() == 2);
  for (const Point& p : points) CHECK(zones.find(p) == uncut.find(p));

  zones.cut(by_ball, whole[1] * 6 / 10);
  REQUIRE(zones.count() == 3);
  const std::vector<std::int64_t> cut = sizes();
  CHECK(cut[0] == whole[0]);
  CHECK(cut[1] + cut[2] == whole[1]);
  CHECK(std::max(cut[1], cut[2]) <= whole[1] * 6 / 10);
  // The worst ball is the first of one heap: that keeps the number.
  for (const double x : {-1.0, 0.5, 2.5, 4.0}) CHECK(zones.find(Point(x, 1, 0)) == 1);
  for (const double x : {5.0, 6.5, 9.0, 11.0}) CHECK(zones.find(Point(x, 1, 0)) == 2);

  zones.cut(by_ball, 1);
  CHECK(zones.count() == worst.size());  // a ball is not cut
}

TEST_CASE("near the middle of several balls a point belongs to that of the worst tet") {
  const std::vector<WorstTet> worst = {{0.1f, Point(0, 0, 0), 10},  // reaches to 30
                                       {0.2f, Point(12, 0, 0), 1},
                                       {0.3f, Point(25, 0, 0), 1}};
  ZoneMap zones(worst);
  REQUIRE(zones.count() == 1);
  std::vector<std::int64_t> by_ball(zones.balls().size(), 1);
  zones.cut(by_ball, 1);
  REQUIRE(zones.count() == 3);
  CHECK(zones.find(Point(1, 0, 0)) == 0);
  CHECK(zones.find(Point(12, 0, 0)) == 0);  // in the middle of a small ball, and yet
  const int of_third = zones.find(Point(25, 0, 0));
  CHECK(of_third > 0);
  CHECK(zones.find(Point(25, 1, 0)) == of_third);
}

TEST_CASE("a point is found in the same zone as by a look at all balls") {
  std::vector<WorstTet> worst;
  for (const Point& p : test::lattice(6).points) worst.push_back({0.1f, 40 * p, 1 + p.x()});
  const ZoneMap zones(worst);
  for (const Point& p : test::lattice(11).points) {
    int expected = -1;
    for (const Ball& ball : zones.balls()) {
      if ((ball.centre - 21 * p).norm() <= ball.radius) expected = static_cast<int>(ball.zone);
    }
    CHECK(zones.find(21 * p) == expected);
  }
}

TEST_CASE("the worst tets are those below a limit, and some if there are fewer") {
  WorstTets all;
  for (int i = 0; i < 1500; ++i) all.add({0.6f + 0.0001f * float(i), Point(i, 0, 0), 1});
  CHECK(all.take().size() == WorstTets::kLeast);
  WorstTets others;
  for (int i = 0; i < 30'000; ++i) others.add({0.4f - 1e-6f * float(i), Point(i, 1, 0), 1});
  all.add(others);
  const std::vector<WorstTet> taken = all.take();
  CHECK(taken.size() == WorstTets::kMost);
  CHECK(taken.front().centre.x() == 29'999);
}

TEST_CASE("a box meets the stretches of all of its points, and few others") {
  const std::vector<Point> points = test::lattice(20).points;
  for (const unsigned shift : {0u, 1u}) {
    const Parting parting = parting_of(points, 13, shift);
    std::size_t found = 0;
    std::size_t needed = 0;
    for (std::size_t i = 0; i < points.size(); i += 7) {
      const Point size(0.1 + double(i % 5), 0.2 + double(i % 3), 0.3);
      const Eigen::AlignedBox3d box(points[i], points[i] + size);
      const std::vector<std::uint32_t> stretches = parting.stretches_of(box);
      CHECK(std::is_sorted(stretches.begin(), stretches.end()));
      std::vector<Point> inside;
      for (int k = 0; k < 1331; ++k) {
        inside.push_back(points[i] + size.cwiseProduct(Point(k % 11, k / 11 % 11, k / 121)) / 10);
      }
      std::vector<std::uint32_t> parts = parting.parts_of(inside);
      std::sort(parts.begin(), parts.end());
      parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
      CHECK(std::includes(stretches.begin(), stretches.end(), parts.begin(), parts.end()));
      found += stretches.size();
      needed += parts.size();
    }
    CHECK(found <= needed + needed / 20);
  }
}
