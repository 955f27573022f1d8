// SPDX-License-Identifier: MIT
#include "viewer/mesh/tet_values.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::viewer;

TEST_CASE("every measure is taken of every tet") {
  const TetMesh mesh(test::kuhn_cube(2, 0.2, 1));
  for (const QualityMeasure& measure : quality_measures()) {
    const TetValue& value = find_tet_value(measure.name);
    const auto values = evaluate_tets(mesh, value);
    REQUIRE(values.size() == mesh.tet_slots());
    const auto& v = mesh.vertices(TetHandle(7));
    CHECK(static_cast<double>(values[7]) ==
          doctest::Approx(measure.evaluate(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]),
                                           mesh.point(v[3]))));
    CHECK(value.range.high == measure.best);
  }
  CHECK(tet_values().size() == quality_measures().size() + 1);
}

TEST_CASE("the quality of a tet is relative to the goal, which lies in the middle of its range") {
  TetMesh mesh(test::kuhn_cube(2, 0.2, 1));
  const TetValue& quality = tet_values().front();
  CHECK(quality.range.low + quality.range.high == 2 * kBadThreshold);
  for (const double least_angle : {30.0, 45.0}) {
    mesh.set_standard(Standard(Goal::symmetric(least_angle)));
    CHECK(evaluate_tets(mesh, quality)[7] == mesh.quality(TetHandle(7)));
  }
  CHECK_THROWS_WITH_AS(find_tet_value("speed"), doctest::Contains("valid: quality, min_sine, "),
                       Error);
}

TEST_CASE("layers count tets from the boundary inwards") {
  const TetMesh mesh(test::kuhn_cube(6, 0, 1));
  const auto layers = distances_from_boundary(mesh);
  for (std::uint32_t i = 0; i < layers.size(); ++i) {
    std::uint32_t least = 1000;
    bool at_boundary = false;
    for (const HalfFace n : mesh.neighbours(TetHandle(i))) {
      at_boundary = at_boundary || n.is_outside();
      if (!n.is_outside()) least = std::min(least, layers[n.tet().index()]);
    }
    CHECK(layers[i] == (at_boundary ? 0 : least + 1));
  }
  CHECK(*std::max_element(layers.begin(), layers.end()) >= 2);
}

TEST_CASE("the worst come first, and not a number never") {
  const std::vector<float> values = {0.5F, std::nanf(""), -1, 0.2F, 0.2F, 0.9F};
  CHECK(worst_tets(values, 3) == std::vector<TetHandle>{TetHandle(2), TetHandle(3), TetHandle(4)});
  CHECK(worst_tets(values, 100).size() == 5);
}

TEST_CASE("the labels of a mesh with two regions are listed") {
  CHECK(region_labels(TetMesh(test::two_regions())) == std::vector<Label>{1, 2});
}
