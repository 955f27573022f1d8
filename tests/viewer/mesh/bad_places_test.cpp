// SPDX-License-Identifier: MIT
#include "viewer/mesh/bad_places.h"

#include <doctest/doctest.h>

#include "kernel/statistics.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::viewer;

TEST_CASE("the places of bad tets hold each bad tet once, the fullest first") {
  TetMesh mesh(test::delaunay_ball(2000, 1));
  mesh.set_standard(Standard(Goal{}));
  const auto places = bad_places(mesh, 1, 100000);
  const std::size_t bad = compute_statistics(mesh).n_bad;
  REQUIRE(bad > 100);
  std::size_t sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    sum += places[i].bad;
    CHECK(places[i].bad <= places[i].tets);
    if (i > 0) CHECK(places[i].bad <= places[i - 1].bad);
    CHECK(misses_goal(mesh, places[i].worst));
  }
  CHECK(sum == bad);
  CHECK(bad_places(mesh, 1, 3).size() == 3);
  CHECK(bad_places(mesh, 0, 3).empty());  // no tet is as bad as that
}
