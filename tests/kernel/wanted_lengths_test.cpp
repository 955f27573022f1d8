// SPDX-License-Identifier: MIT
// Wanted lengths: against integrals by many small steps, and what a change may do to edges.
#include "kernel/wanted_lengths.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "contract/zoo.h"
#include "kernel/star.h"
#include "kernel/transaction.h"
#include "kernel/workspace.h"

using namespace tetmend;
using namespace tetmend::contract;

namespace {

EdgePlaces along_x(double length) {
  return {Point(0, 0, 0), Point(length, 0, 0)};
}

}  // namespace

TEST_CASE("the relative length of an edge is the integral of one over the wanted length") {
  const WantedLengths field([](const Point& p) { return 0.1 + 0.3 * p.x(); });
  for (const double end : {1e-6, 0.01, 0.5, 2.0}) {
    constexpr int kSteps = 20000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double x = end * (i + 0.5) / kSteps;
      sum += end / kSteps / field.length({x, 0, 0});
    }
    CHECK(field.relative_length({0, 0, 0}, {end, 0, 0}) == doctest::Approx(sum).epsilon(1e-6));
    CHECK(field.relative_length({end, 0, 0}, {0, 0, 0}) == doctest::Approx(sum).epsilon(1e-6));
  }
}

TEST_CASE("an edge whose ends want long edges is long where short ones are wanted in between") {
  const WantedLengths field([](const Point& p) { return std::abs(p.x() - 0.5) < 0.2 ? 0.1 : 0.5; });
  CHECK(field.relative_length({0, 0, 0}, {1, 0, 0}) ==
        doctest::Approx(0.4 / 0.1 + 0.6 / 0.5).epsilon(0.2));
  CHECK(field.relative_length({0, 0, 0}, {0, 1, 0}) == doctest::Approx(2));
  CHECK(field.misfits(std::vector<EdgePlaces>{{Point(0, 0, 0), Point(1, 0, 0)}})[0] < 0.3F);
}

TEST_CASE("the middle of an edge makes two of the same relative length") {
  const WantedLengths field([](const Point& p) { return 0.1 + 0.3 * p.x(); });
  const Point a(0, 0, 0);
  const Point b(2, 0, 0);
  const Point middle = field.middle(a, b);
  CHECK(field.relative_length(a, middle) == doctest::Approx(field.relative_length(middle, b)));
  CHECK(middle.x() < 1);
}

TEST_CASE(
    "an edge fits from 0.71 to 1.41 of the wanted length, and less the farther it is outside") {
  CHECK(WantedLengths::fit(0.7072) == 1);
  CHECK(WantedLengths::fit(1.4142) == 1);
  CHECK(WantedLengths::fit(0.35) < WantedLengths::fit(0.7));
  CHECK(WantedLengths::fit(3) < WantedLengths::fit(1.5));
  CHECK(WantedLengths::fit(0.5) == doctest::Approx(WantedLengths::fit(2)));
}

TEST_CASE("a change may leave no more edges outside the range than it found, and none farther") {
  const WantedLengths field(1);
  const std::vector<EdgePlaces> good = {along_x(1), along_x(1.4)};
  const std::vector<EdgePlaces> one_off = {along_x(1), along_x(1.6)};
  const std::vector<EdgePlaces> two_off = {along_x(0.6), along_x(1.6)};
  const std::vector<EdgePlaces> far_off = {along_x(1), along_x(2)};
  CHECK(field.admits({}, good));
  CHECK(field.admits(one_off, good));
  CHECK(field.admits(one_off, one_off));
  CHECK_FALSE(field.admits(good, one_off));
  CHECK_FALSE(field.admits(one_off, two_off));
  CHECK_FALSE(field.admits(one_off, far_off));
  CHECK(field.admits(far_off, one_off));
}

TEST_CASE("a transaction lists the edges that it took away, made and moved, each once") {
  TetMesh mesh(kuhn_cube(2, 0, 1));
  Workspace workspace(mesh);
  const auto middle = [&] {
    for (std::uint32_t i = 0;; ++i) {
      if (!mesh.is_fixed(VertexHandle(i))) return VertexHandle(i);
    }
  }();
  const std::vector<HalfFace> link = [&] {
    const auto found = tetmend::link(mesh, middle);
    return std::vector<HalfFace>(found.begin(), found.end());
  }();
  const std::size_t degree = one_ring(mesh, middle).size();
  const Point from = mesh.point(middle);
  Transaction transaction(mesh, workspace);
  const VertexMove move{middle, from + Point(0.01, 0.02, 0.03), link};
  REQUIRE(transaction.move_vertices({&move, 1}) == EditResult::made);
  std::vector<EdgePlaces> before;
  std::vector<EdgePlaces> now;
  transaction.list_changed_edges(before, now);
  CHECK(before.size() == degree);
  CHECK(now.size() == degree);
  const auto at = [](const Point& p) {
    return [p](const EdgePlaces& edge) { return edge[0] == p || edge[1] == p; };
  };
  CHECK(std::all_of(before.begin(), before.end(), at(from)));
  CHECK(std::all_of(now.begin(), now.end(), at(move.point)));
}
