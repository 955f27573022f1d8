// SPDX-License-Identifier: MIT
// Tets side by side against tets one by one, bit for bit.
#include "kernel/tet_batch.h"

#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/tets.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const std::array<Standard, 4> kStandards = {Standard(), Standard(Goal{}), Standard(Goal{35, 140}),
                                            Standard(Goal{20, 170}, Standard::Terms::sine)};

TetPoints random_tet(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> coordinate(-size, size);
  TetPoints tet;
  for (Point& p : tet) p = Point(coordinate(random), coordinate(random), coordinate(random));
  return tet;
}

void check_batch(const std::vector<TetPoints>& tets, const Standard& standard) {
  TetBatch batch;
  batch.add(Point(9, 0, 0), Point(0, 9, 0), Point(0, 0, 9), Point(9, 9, 9));
  batch.clear();
  for (const auto& [a, b, c, d] : tets) batch.add(a, b, c, d);
  batch.evaluate(standard);
  for (std::size_t i = 0; i < tets.size(); ++i) {
    CAPTURE(i);
    const TetPoints& t = tets[i];
    const auto quality = static_cast<Quality>(standard.quality(t[0], t[1], t[2], t[3]));
    CHECK(std::bit_cast<std::uint32_t>(batch.quality(i)) == std::bit_cast<std::uint32_t>(quality));
    CHECK(batch.is_certified_positive(i) == certified_positive(t[0], t[1], t[2], t[3]));
  }
}

}  // namespace

TEST_CASE(
    "a batch of tets has the qualities and certificates of the single tets, to the last bit") {
  std::mt19937 random(1);
  for (const double size : {1e-40, 1e-3, 1.0, 1e6}) {
    for (std::size_t count = 1; count <= 9; ++count) {
      std::vector<TetPoints> tets;
      while (tets.size() < count) tets.push_back(random_tet(random, size));
      for (const Standard& standard : kStandards) check_batch(tets, standard);
    }
  }
}

TEST_CASE("flat, degenerate and nearly flat tets in a batch are judged as by themselves") {
  std::mt19937 random(2);
  std::vector<TetPoints> tets;
  for (int i = 0; i < 100; ++i) {
    TetPoints tet = random_tet(random, 1);
    const Point middle = (tet[0] + tet[1] + tet[2]) / 3;
    for (const double height : {0.0, 1e-17, -1e-17, 1e-16, 1e-15, 1e-9}) {
      tet[3] = middle + height * (tet[1] - tet[0]).cross(tet[2] - tet[0]);
      tets.push_back(tet);
    }
    tets.push_back({tet[0], tet[1], tet[2], tet[0]});
    tets.push_back({tet[0], tet[0], tet[0], tet[0]});
  }
  for (const Standard& standard : kStandards) check_batch(tets, standard);
}
