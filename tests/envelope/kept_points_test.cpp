// SPDX-License-Identifier: MIT
#include "envelope/kept_points.h"

#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include "envelope/features.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("points of periodic links, other elements and MEDIT's marks are corners") {
  const MeshData plain = kuhn_cube(3, 0, 1);
  const auto number = [&](double x, double y) {  // on the upper side, in thirds
    const Point p(x / 3, y / 3, 1);
    const auto at = std::find_if(plain.points.begin(), plain.points.end(),
                                 [&](const Point& q) { return (p - q).norm() < 1e-9; });
    return static_cast<std::uint32_t>(at - plain.points.begin());
  };
  const std::uint32_t a = number(1, 1);
  const std::uint32_t b = number(2, 1);
  const std::uint32_t c = number(2, 2);
  const auto corners = [](const MeshData& data) {
    const TetMesh mesh = TetMesh::sorted(data);
    const SurfaceFeatures found =
        find_features(mesh, {.flat = true, .kept = kept_vertices(mesh, find_kept_points(data))});
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
      if (found.places[i] == SurfacePlace::corner) result.push_back(mesh.origin(VertexHandle(i)));
    }
    return result;
  };
  const auto has = [](const std::vector<std::uint32_t>& list, std::uint32_t v) {
    return std::find(list.begin(), list.end(), v) != list.end();
  };
  CHECK(corners(plain).size() == 8);

  const auto marked = [&](const char* name, int dimension) {
    MeshData data = plain;
    if (dimension == 1) data.edges = {{{a, b}, 0}};
    if (dimension == 2) data.triangles = {{{a, b, c}, 0}};
    Group group;
    group.name = name;
    group.dimension = dimension;
    group.members = {dimension == 0 ? a : 0};
    data.groups = {group};
    return corners(data);
  };
  CHECK(has(marked("Corners", 0), a));
  CHECK_FALSE(has(marked("a set", 0), a));
  CHECK(has(marked("RequiredEdges", 1), b));
  CHECK(has(marked("RequiredTriangles", 2), c));
  CHECK_FALSE(has(marked("RequiredEdges", 1), c));

  MeshData periodic = plain;
  periodic.periodic.push_back({2, 1, 2, {}, {{a, b}}});
  CHECK(has(corners(periodic), a));
  CHECK(has(corners(periodic), b));
  MeshData hybrid = plain;
  OtherElements others;
  others.vertex_count = 1;
  others.vertices = {c};
  hybrid.other_elements = {others};
  CHECK(has(corners(hybrid), c));
}
