// SPDX-License-Identifier: MIT
#include "schedule/limit/inverted_tets.h"

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "tests/support/hub.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Two cells in each direction: one free vertex, in the middle, which is put elsewhere.
MeshData cube_with_middle_at(const Point& place) {
  MeshData data = kuhn_cube(2, 0, 1);
  for (Point& p : data.points) {
    if ((p - Point(0.5, 0.5, 0.5)).norm() < 1e-9) p = place;
  }
  return data;
}

}  // namespace

TEST_CASE("a sound mesh has no reason") {
  CHECK(count_inverted(TetMesh(kuhn_cube(3, 0.2, 1))).all() == 0);
}

TEST_CASE("a vertex in the wrong place has a better one") {
  const TetMesh mesh(cube_with_middle_at({1.2, 0.5, 0.5}));
  const InvertedTets count = count_inverted(mesh);
  REQUIRE(count_not_positive(mesh) > 0);
  CHECK(count.open == count_not_positive(mesh));
  CHECK(count.all() == count.open);
}

TEST_CASE("a vertex whose link is tangled has no place, and fixed vertices none to go to") {
  MeshData data = cube_with_middle_at({0.5, 0.5, 0.5});
  for (Point& p : data.points) {  // the middle of one side is pushed through the opposite one
    if ((p - Point(1, 0.5, 0.5)).norm() < 1e-9) p = Point(-0.5, 0.5, 0.5);
  }
  const TetMesh mesh(data);
  const InvertedTets count = count_inverted(mesh);
  REQUIRE(count_not_positive(mesh) > 0);
  CHECK(count.open == 0);
  CHECK(count.sealed > 0);
  CHECK(count.all() == count_not_positive(mesh));

  for (std::uint32_t v = 0; v < data.points.size(); ++v) data.required_vertices.push_back(v);
  const InvertedTets fixed = count_inverted(TetMesh(data));
  CHECK(fixed.fixed == count.all());
  CHECK(fixed.all() == count.all());
}

TEST_CASE("frozen tets count as such") {
  TetMesh mesh(cube_with_middle_at({1.2, 0.5, 0.5}));
  mesh.freeze([](TetHandle) { return true; });
  const InvertedTets count = count_inverted(mesh);
  CHECK(count.frozen == count_not_positive(mesh));
  CHECK(count.all() == count.frozen);
}

TEST_CASE("a vertex that many inverted tets share is asked once") {
  // Asked for each of 10,000 tets, whose star is as large, it would take minutes.
  MeshData data = hub(5000);
  data.points[0] = {3, 0, 0};
  const TetMesh mesh(data);
  const InvertedTets count = count_inverted(mesh);
  REQUIRE(count_not_positive(mesh) > 1000);
  CHECK(count.open == count_not_positive(mesh));
}
