// SPDX-License-Identifier: MIT
#include "envelope/kept_points.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "envelope/envelope.h"
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

TEST_CASE(
    "faces between held vertices are patches that nothing takes a face from, edges are lines") {
  const TetMesh mesh(kuhn_cube(4, 0, 1));
  for (const double share : {0.0, 0.05}) {
    CAPTURE(share);
    const SurfaceFeatures free = find_features(mesh, {.flat = share == 0, .kept = {}});
    // Two faces of one patch, off its border, and the edge between them.
    std::vector<VertexHandle> inner;
    std::array<std::array<VertexHandle, 3>, 2> pair;
    std::array<VertexHandle, 2> edge;
    for (const auto& one : free.faces) {
      for (const auto& other : free.faces) {
        std::vector<VertexHandle> common;
        for (const VertexHandle v : one.vertices) {
          const auto& w = other.vertices;
          if (std::find(w.begin(), w.end(), v) != w.end()) common.push_back(v);
        }
        if (one.patch != other.patch || common.size() != 2 || !inner.empty()) continue;
        inner.assign(one.vertices.begin(), one.vertices.end());
        pair = {one.vertices, other.vertices};
        edge = {common[0], common[1]};
      }
    }
    REQUIRE(inner.size() == 3);
    const auto opposite = [&](const std::array<VertexHandle, 3>& face) {
      return *std::find_if(face.begin(), face.end(),
                           [&](VertexHandle v) { return v != edge[0] && v != edge[1]; });
    };
    const auto flips = [&](const std::vector<VertexHandle>& held) {
      const auto guard = Envelope::of(mesh, {.share = share, .held = held});
      const auto journal = guard->make_journal();
      std::vector<SurfaceFace> before;
      std::vector<SurfaceFace> after;
      const auto add = [&](const std::array<VertexHandle, 3>& v, std::vector<SurfaceFace>& to) {
        to.push_back({v, {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])}});
      };
      for (const auto& face : pair) add(face, before);
      for (std::size_t i = 0; i < 2;
           ++i) {  // each takes the tip of the other for one end of the edge
        auto face = pair[i];
        *std::find(face.begin(), face.end(), edge[i]) = opposite(pair[1 - i]);
        add(face, after);
      }
      return guard->replace(before, after, *journal);
    };
    CHECK(flips({}));
    CHECK(flips({edge[0]}));
    CHECK_FALSE(flips({edge[0], edge[1]}));
    CHECK_FALSE(flips(inner));
    const SurfaceFeatures found =
        find_features(mesh, {.flat = share == 0, .kept = {}, .held = inner});
    const auto held = std::count_if(found.patches.begin(), found.patches.end(),
                                    [](const auto& patch) { return patch.held; });
    CHECK(held == 1);
    CHECK(std::count_if(found.lines.begin(), found.lines.end(),
                        [](const auto& line) { return line.held; }) == 3);
  }
}
