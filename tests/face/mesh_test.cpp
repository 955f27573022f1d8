// SPDX-License-Identifier: MIT
// A user's mesh: arrays in, checked, and arrays out.
#include <functional>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/face/meshes.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

void check_equal(const MeshArrays& a, const MeshArrays& b) {
  CHECK(a.points == b.points);
  CHECK(a.point_labels == b.point_labels);
  CHECK(a.tets == b.tets);
  CHECK(a.tet_labels == b.tet_labels);
  CHECK(a.triangles == b.triangles);
  CHECK(a.triangle_labels == b.triangle_labels);
  CHECK(a.edges == b.edges);
  CHECK(a.edge_labels == b.edge_labels);
  CHECK(a.required_vertices == b.required_vertices);
}

std::string complaint(const std::function<void(MeshArrays&)>& damage) {
  MeshArrays arrays = two_tets();
  damage(arrays);
  return message_of([&] { Mesh(std::move(arrays)); });
}

}  // namespace

TEST_CASE("arrays come out of a mesh as they went in") {
  Mesh mesh(two_tets());
  check_equal(mesh.arrays(), two_tets());
  CHECK(mesh.point_count() == 5);
  CHECK(mesh.tet_count() == 2);
  CHECK(mesh.triangle_count() == 2);
  CHECK(mesh.edge_count() == 1);
  CHECK(mesh.tets()[1] == std::array<std::uint32_t, 4>{1, 2, 3, 4});
  CHECK(mesh.points()[4][2] == 1);
  CHECK(mesh.file().empty());
  check_equal(std::move(mesh).take_arrays(), two_tets());
}

TEST_CASE("labels that are not given are 0, and points without any have no array of them") {
  MeshArrays arrays = two_tets();
  arrays.point_labels = {0, 0, 0, 0, 0};
  arrays.tet_labels = arrays.triangle_labels = arrays.edge_labels = {};
  const Mesh mesh(arrays);
  CHECK(mesh.point_labels().empty());
  CHECK(mesh.arrays().tet_labels == std::vector<std::int32_t>{0, 0});
  CHECK(mesh.arrays().triangle_labels == std::vector<std::int32_t>{0, 0});
  CHECK(mesh.arrays().edge_labels == std::vector<std::int32_t>{0});
}

TEST_CASE("a copy is a mesh of its own, and what was moved from is empty") {
  Mesh mesh(two_tets());
  Mesh copy = mesh;
  const Mesh moved = std::move(mesh);
  mesh = Mesh();
  check_equal(copy.arrays(), two_tets());
  check_equal(moved.arrays(), two_tets());
  CHECK(mesh.tet_count() == 0);
  CHECK(mesh.points().empty());
  copy = mesh;
  CHECK(copy.tet_count() == 0);
  check_equal(std::move(copy).take_arrays(), {});
  CHECK(copy.tet_count() == 0);
}

TEST_CASE("several threads may ask a mesh for its arrays at once") {
  const Mesh mesh = load(asset("sheet.mesh"));
  std::vector<const void*> found(8);
  std::vector<std::thread> threads;
  for (const void*& each : found) {
    threads.emplace_back([&] { each = mesh.tets().data(); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const void* each : found) CHECK(each == mesh.tets().data());
}

TEST_CASE("a coordinate that is not finite is an error with its place") {
  for (const double x :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    const std::string text = complaint([&](MeshArrays& a) { a.points[3][1] = x; });
    CHECK(text.starts_with("points[3]: (0"));
    CHECK(text.ends_with(") is not finite"));
  }
}

TEST_CASE("a vertex number out of range or twice in an element is an error with its place") {
  CHECK(complaint([](MeshArrays& a) { a.tets[1][2] = 5; }) ==
        "tets[1]: (1, 2, 5, 4): no point 5, there are 5, counted from 0");
  CHECK(complaint([](MeshArrays& a) { a.tets[0][0] = 3; }) ==
        "tets[0]: (3, 1, 2, 3): the same vertex twice, counted from 0");
  CHECK(
      complaint([](MeshArrays& a) { a.triangles[1][0] = 0xFFFFFFFF; }).starts_with("triangles[1]"));
  CHECK(complaint([](MeshArrays& a) { a.edges[0][0] = 1; }).starts_with("edges[0]: (1, 1)"));
  CHECK(complaint([](MeshArrays& a) {
          a.required_vertices = {0, 5};
        }).starts_with("required_vertices[1]: no point 5"));
}

TEST_CASE("labels are one for each entity") {
  CHECK(complaint([](MeshArrays& a) { a.point_labels.pop_back(); }) ==
        "point_labels: 4 labels for 5 points");
  CHECK(complaint([](MeshArrays& a) { a.tet_labels.push_back(0); }).starts_with("tet_labels: 3"));
  CHECK(complaint([](MeshArrays& a) { a.triangle_labels.pop_back(); }) ==
        "triangle_labels: 1 labels for 2 triangles");
  CHECK(complaint([](MeshArrays& a) { a.edge_labels = {1, 2}; }).starts_with("edge_labels: 2"));
}
