// SPDX-License-Identifier: MIT
// Walls and sectors of cubes, of faces that stand free, and of frozen tets.
#include "schedule/limit/walls.h"

#include <map>
#include <numbers>
#include <set>

#include <doctest/doctest.h>

#include "kernel/shell.h"
#include "tests/support/tets.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::vector<HalfFace> all_walls(const TetMesh& mesh) {
  std::vector<HalfFace> walls;
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned f = 0; f < 4; ++f) {
      if (is_wall(mesh, HalfFace(t, f))) walls.emplace_back(t, f);
    }
  }
  return walls;
}

/// How often each angle occurs, in whole degrees.
std::map<int, int> angles(const TetMesh& mesh) {
  std::map<int, int> count;
  for (const HalfFace wall : all_walls(mesh)) {
    for (unsigned i = 0; i < 3; ++i) {
      ++count[static_cast<int>(std::lround(find_sector(mesh, wall, i).angle / kDegree))];
    }
  }
  return count;
}

}  // namespace

TEST_CASE("the sectors of a cube are right angles at its edges and flat elsewhere") {
  const TetMesh mesh(kuhn_cube(2, 0, 1));
  // 48 triangles; 12 edges of two pieces each, seen from both sides.
  CHECK(angles(mesh) == std::map<int, int>{{90, 48}, {180, 96}});
  // Tets inside do not matter.
  CHECK(angles(TetMesh(kuhn_cube(2, 0.3, 1))) == angles(mesh));
}

TEST_CASE("a sector is the same from both of its walls") {
  for (const NamedMesh& named : zoo()) {
    CAPTURE(named.name);
    const TetMesh mesh(named.data);
    for (const HalfFace wall : all_walls(mesh)) {
      for (unsigned i = 0; i < 3; ++i) {
        const Sector sector = find_sector(mesh, wall, i);
        const auto from = mesh.vertices(wall);
        const auto back = mesh.vertices(sector.other);
        const auto j =
            static_cast<unsigned>(std::find(back.begin(), back.end(), sector.apex) - back.begin());
        REQUIRE(j < 3);
        // The two walls run along the edge in opposite directions.
        CHECK(back[(j + 1) % 3] == from[(i + 2) % 3]);
        CHECK(back[(j + 2) % 3] == from[(i + 1) % 3]);
        const Sector again = find_sector(mesh, sector.other, j);
        CHECK(again.other == wall);
        CHECK(again.apex == from[i]);
        CHECK(again.angle == doctest::Approx(sector.angle).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("a face that stands free inside has a full turn at its rim, and divides sectors") {
  const TetMesh plain(shell_mesh({.degree = 6}));
  const TetMesh mesh(shell_with_constrained_face());
  const auto before = angles(plain);
  CHECK(all_walls(mesh).size() == all_walls(plain).size() + 2);
  CHECK(!before.contains(360));
  // The supporting edge, from both sides of the face; its other two edges lie on the boundary.
  CHECK(angles(mesh)[360] == 2);
}

TEST_CASE("the faces between frozen tets and others are walls, those among frozen tets are not") {
  TetMesh mesh(shell_mesh({.degree = 6}));
  const std::size_t boundary = all_walls(mesh).size();
  mesh.freeze([](TetHandle t) { return t.index() < 2; });
  CHECK(all_walls(mesh).size() == boundary + 4);
  const auto count = angles(mesh);
  CHECK(count.at(120) == 2);  // of the two frozen tets at the supporting edge
  CHECK(count.at(240) == 2);
}
