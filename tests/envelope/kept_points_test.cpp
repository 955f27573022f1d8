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

  // A face without a corner of the cube and off its edges.
  const auto faces = find_features(TetMesh(plain), {.flat = true, .kept = {}});
  const auto inner = std::find_if(faces.faces.begin(), faces.faces.end(), [&](const auto& face) {
    return std::all_of(face.vertices.begin(), face.vertices.end(), [&](VertexHandle v) {
      return faces.places[v.index()] == SurfacePlace::smooth;
    });
  });
  REQUIRE(inner != faces.faces.end());
  const auto inner_face = static_cast<std::uint32_t>(inner - faces.faces.begin());

  const auto marked = [&](const char* name, int dimension) {
    MeshData data = plain;
    if (dimension == 1) {  // a line through a and b
      data.edges = {{{number(0, 1), a}, 0}, {{a, b}, 0}, {{b, number(3, 1)}, 0}};
    }
    if (dimension == 2) {
      for (const auto& face : find_features(TetMesh(plain), {}).faces) {
        const auto& v = face.vertices;
        data.triangles.push_back({{v[0].index(), v[1].index(), v[2].index()}, 0});
      }
    }
    Group group;
    group.name = name;
    group.dimension = dimension;
    group.members = {dimension == 0 ? a : dimension == 1 ? 1 : inner_face};
    data.groups = {group};
    return corners(data);
  };
  CHECK(has(marked("Corners", 0), a));
  CHECK_FALSE(has(marked("a set", 0), a));
  CHECK(has(marked("RequiredEdges", 1), a));
  CHECK(has(marked("RequiredEdges", 1), b));
  CHECK_FALSE(has(marked("Ridges", 1), a));
  CHECK(marked("RequiredTriangles", 2).size() == 11);
  CHECK(marked("a wall", 2).size() == 8);

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
