// SPDX-License-Identifier: MIT
#include "envelope/features.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "kernel/formats/tet_mesh_io.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::size_t count(const SurfaceFeatures& features, SurfacePlace place) {
  return static_cast<std::size_t>(
      std::count(features.places.begin(), features.places.end(), place));
}

}  // namespace

TEST_CASE("a cube of 3 x 3 x 3 cells has 6 patches, 12 lines and 8 corners, flat or not") {
  const TetMesh mesh(kuhn_cube(3, 0.2, 1));
  for (const bool flat : {false, true}) {
    const SurfaceFeatures found = find_features(mesh, {.flat = flat, .kept = {}});
    CHECK(found.faces.size() == 108);
    CHECK(found.patches.size() == 6);
    CHECK(found.lines.size() == 12);
    CHECK(found.edges.size() == 36);
    CHECK(count(found, SurfacePlace::corner) == 8);
    CHECK(count(found, SurfacePlace::ridge) == 24);
    CHECK(count(found, SurfacePlace::smooth) == 24);
    CHECK(count(found, SurfacePlace::inside) == 8);
  }
}

TEST_CASE("planes of an oblique cube are found, and their normals look outward") {
  MeshData data = kuhn_cube(4, 0.2, 1);
  const Eigen::AngleAxisd turn(0.7, Point(1, 2, 3).normalized());
  for (Point& p : data.points) p = turn * p + Point(5, 6, 7);
  const TetMesh mesh(data);
  const SurfaceFeatures found = find_features(mesh, {.flat = true, .kept = {}});
  CHECK(found.patches.size() == 6);
  CHECK(found.lines.size() == 12);
  const Point middle = turn * Point(0.5, 0.5, 0.5) + Point(5, 6, 7);
  for (const auto& patch : found.patches) {
    CHECK(patch.normal.norm() == doctest::Approx(1));
    CHECK(patch.normal.dot(patch.origin - middle) == doctest::Approx(0.5));
  }
}

TEST_CASE("two regions share an interface with a line around it") {
  const TetMesh mesh(two_regions());
  const SurfaceFeatures found = find_features(mesh, {});
  CHECK(found.patches.size() == 11);  // 2 x 5 outside and the interface
  const auto interior = std::find_if(found.patches.begin(), found.patches.end(),
                                     [](const auto& patch) { return patch.interior; });
  REQUIRE(interior != found.patches.end());
  CHECK(interior->sides == std::array<Label, 2>{1, 2});
  CHECK(count(found, SurfacePlace::corner) == 12);  // of the cube, and where the interface ends
  for (const auto& face : found.faces) {
    if (!found.patches[face.patch].interior) continue;
    const auto& v = face.vertices;
    const Point normal =
        (mesh.point(v[1]) - mesh.point(v[0])).cross(mesh.point(v[2]) - mesh.point(v[0]));
    CHECK(normal.z() > 0);  // as seen from the larger label, above
  }
}

TEST_CASE("sheets that touch keep the vertices where they do") {
  const TetMesh at_vertex(touching_at_vertex());
  const SurfaceFeatures one = find_features(at_vertex, {.angle = 179, .kept = {}});
  CHECK(count(one, SurfacePlace::corner) == 1);
  const TetMesh at_edge(touching_at_edge());
  const SurfaceFeatures two = find_features(at_edge, {.angle = 179, .kept = {}});
  CHECK(two.edges.size() == 1);
  CHECK(count(two, SurfacePlace::corner) == 2);
}

TEST_CASE("what the file names stays: an edge in a plane is a line, a vertex a corner") {
  MeshData data = kuhn_cube(2, 0, 1);
  const auto number = [&](const Point& p) {
    return static_cast<std::uint32_t>(std::find(data.points.begin(), data.points.end(), p) -
                                      data.points.begin());
  };
  const std::uint32_t middle = number({0.5, 0.5, 1});
  data.edges.push_back({{middle, number({0.5, 0, 1})}, 7});
  data.edges.push_back({{middle, number({0.5, 1, 1})}, 7});
  data.required_vertices.push_back(number({0, 0.5, 0.5}));
  const TetMesh mesh(data);
  const SurfaceFeatures found = find_features(mesh, {.flat = true, .kept = {}});
  CHECK(found.places[middle] == SurfacePlace::ridge);
  CHECK(found.places[number({0, 0.5, 0.5})] == SurfacePlace::corner);
  CHECK(found.places[number({0.5, 0, 1})] == SurfacePlace::corner);
  const auto named = std::find_if(found.lines.begin(), found.lines.end(),
                                  [](const auto& line) { return line.named; });
  REQUIRE(named != found.lines.end());
  CHECK(named->label == 7);
}

TEST_CASE("vertices named by the caller and frozen ones are corners") {
  TetMesh mesh(kuhn_cube(3, 0, 1));
  const SurfaceFeatures free = find_features(mesh, {.flat = true, .kept = {}});
  const auto smooth = static_cast<std::uint32_t>(
      std::find(free.places.begin(), free.places.end(), SurfacePlace::smooth) -
      free.places.begin());
  const SurfaceFeatures kept = find_features(mesh, {.flat = true, .kept = {VertexHandle(smooth)}});
  CHECK(kept.places[smooth] == SurfacePlace::corner);
  mesh.freeze([&](TetHandle t) { return mesh.local_index(t, VertexHandle(smooth)) < 4; });
  CHECK(find_features(mesh, {.flat = true, .kept = {}}).places[smooth] == SurfacePlace::corner);
}

TEST_CASE("on the ball every vertex is a corner when flat, and smooth when bends are no features") {
  const TetMesh mesh(delaunay_ball(200, 3));
  const SurfaceFeatures flat = find_features(mesh, {.flat = true, .kept = {}});
  CHECK(count(flat, SurfacePlace::smooth) == 0);
  CHECK(count(flat, SurfacePlace::ridge) == 0);
  CHECK(flat.patches.size() == flat.faces.size());
  const SurfaceFeatures round = find_features(mesh, {.angle = 179, .kept = {}});
  CHECK(count(round, SurfacePlace::corner) == 0);
  CHECK(round.patches.size() == 1);
}
