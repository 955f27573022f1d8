// SPDX-License-Identifier: MIT
// What walls allow is never less than what a mesh has.
#include "schedule/limit/wall_probe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "schedule/schedule.h"
#include "tests/support/tets.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// The smallest range of angles, in radians, that holds those of the tets on some walls.
AngleRange angles_on(const TetMesh& mesh, const std::vector<HalfFace>& walls) {
  AngleRange range{std::numbers::pi, 0};
  for (const HalfFace wall : walls) {
    const TetVertices& v = mesh.vertices(wall.tet());
    for (const double angle :
         dihedral_angles(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]))) {
      range.low = std::min(range.low, angle * kDegree);
      range.high = std::max(range.high, angle * kDegree);
    }
  }
  return range;
}

/// Number of walls whose probe denies what the mesh has.
std::size_t count_denied(const TetMesh& mesh) {
  std::size_t denied = 0;
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned f = 0; f < 4; ++f) {
      if (!is_wall(mesh, HalfFace(t, f))) continue;
      const WallProbe probe(mesh, HalfFace(t, f));
      for (unsigned long scope = 0; scope < 16; ++scope) {
        if (!probe.allows(angles_on(mesh, probe.walls(scope)), scope)) ++denied;
      }
    }
  }
  return denied;
}

}  // namespace

TEST_CASE("walls allow the angles of every mesh between them, before and after improvement") {
  Registry registry = Registry::builtin();
  for (const NamedMesh& named : zoo()) {
    CAPTURE(named.name);
    TetMesh mesh(named.data);
    if (count_not_positive(mesh) > 0) continue;  // such tets have no place between walls
    CHECK(count_denied(mesh) == 0);
    Run run(mesh, registry);
    improve(run);
    CHECK(count_denied(mesh) == 0);
  }
}

TEST_CASE("a tet alone allows exactly its own angles") {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0.1, 0.8, 0}, {0.3, 0.2, 0.4}};
  data.tets = {{{0, 1, 2, 3}, 0}};
  const TetMesh mesh(data);
  const AngleRange own = angles_on(mesh, {HalfFace(TetHandle(0), 0)});
  constexpr double kLess = 1e-3;
  for (unsigned f = 0; f < 4; ++f) {
    const WallProbe probe(mesh, HalfFace(TetHandle(0), f));
    CHECK(probe.allows(own, 0b1111));
    CHECK(!probe.allows({own.low + kLess, own.high}, 0b1111));
    // A smaller largest angle could only come from another apex, which would need gaps.
    CHECK(!probe.allows({own.low, own.high - kLess}, 0b1111));
    CHECK(probe.walls(0b1111).size() == 4);
  }
}

TEST_CASE("a tet that fills one sector must leave nothing or enough at the other edges") {
  // Two tets of 20 degrees at the edge 0 1. Vertex 3 lies in the middle between 2 and 4. So one tet
  // 0 1 2 4 would leave nothing at the edge 0 2, where the next wall is 0 2 3.
  MeshData data;
  data.points = {{0, 0, -0.5}, {0, 0, 0.5}};
  for (const double degrees : {0.0, 20.0, 40.0}) {
    const double radius = degrees == 20 ? std::cos(20 * kDegree) : 1;
    data.points.emplace_back(radius * std::cos(degrees * kDegree),
                             radius * std::sin(degrees * kDegree), 0);
  }
  data.tets = {{{0, 1, 2, 3}, 0}, {{0, 1, 3, 4}, 0}};
  const TetMesh mesh(data);
  const TetHandle t(0);
  const WallProbe probe(mesh, HalfFace(t, mesh.local_index(t, VertexHandle(3))));
  const auto corners = mesh.vertices(probe.wall());
  const auto bit = [&](std::uint32_t opposite) {
    const auto at = std::find(corners.begin(), corners.end(), VertexHandle(opposite));
    return WallProbe::Scope(1u << (at - corners.begin()));
  };
  const AngleRange good{30 * kDegree, 150 * kDegree};
  CHECK(probe
            .sector(static_cast<unsigned>(
                std::find(corners.begin(), corners.end(), VertexHandle(2)) - corners.begin()))
            .angle == doctest::Approx(40 * kDegree));
  CHECK(probe.allows(good, bit(2)));
  CHECK(!probe.allows(good, bit(2) | bit(1)));
}
