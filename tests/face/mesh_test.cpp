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
  CHECK(a.point_data == b.point_data);
  CHECK(a.tet_data == b.tet_data);
  CHECK(a.triangle_data == b.triangle_data);
  CHECK(a.edge_data == b.edge_data);
  CHECK(a.tet_parts == b.tet_parts);
  CHECK(a.triangle_parts == b.triangle_parts);
  CHECK(a.edge_parts == b.edge_parts);
  CHECK(a.groups == b.groups);
  CHECK(a.mid_nodes == b.mid_nodes);
}

using Integers = std::vector<std::int32_t>;
using LongIntegers = std::vector<std::int64_t>;
using Singles = std::vector<float>;
using Doubles = std::vector<double>;

/// Data of every type, and groups of every kind.
MeshArrays with_data() {
  MeshArrays arrays = two_tet_arrays();
  arrays.point_data = {{"velocity", 3, Doubles(15, 0.5)}, {"mark", 1, Integers{1, 2, 3, 4, 5}}};
  arrays.tet_data = {{"density", 1, Singles{1.5F, 2.5F}}};
  arrays.triangle_data = {{"number", 1, LongIntegers{1LL << 40, -7}}};
  arrays.edge_data = {{"width", 2, Doubles{0.25, 0.75}}};
  arrays.tet_parts = {1, 2};
  arrays.triangle_parts = {3, 3};
  arrays.edge_parts = {4};
  arrays.groups = {{.dimension = 3, .number = 1, .name = "upper", .parts = {2}},
                   {.dimension = 2, .number = 1, .name = "wall", .members = {1}},
                   {.dimension = 2, .number = 5, .name = "glue"},
                   {.dimension = 0, .name = "corner", .members = {4, 0}}};
  return arrays;
}

std::string complaint(const std::function<void(MeshArrays&)>& damage) {
  MeshArrays arrays = two_tet_arrays();
  damage(arrays);
  return message_of([&] { Mesh(std::move(arrays)); });
}

}  // namespace

TEST_CASE("arrays come out of a mesh as they went in") {
  Mesh mesh(two_tet_arrays());
  check_equal(mesh.arrays(), two_tet_arrays());
  CHECK(mesh.point_count() == 5);
  CHECK(mesh.tet_count() == 2);
  CHECK(mesh.triangle_count() == 2);
  CHECK(mesh.edge_count() == 1);
  CHECK(mesh.tets()[1] == std::array<std::uint32_t, 4>{1, 2, 3, 4});
  CHECK(mesh.points()[4][2] == 1);
  CHECK(mesh.file().empty());
  check_equal(std::move(mesh).take_arrays(), two_tet_arrays());
}

TEST_CASE("data, parts and groups come out of a mesh as they went in") {
  Mesh mesh(with_data());
  CHECK(mesh.point_data() == with_data().point_data);
  CHECK(mesh.tet_data() == with_data().tet_data);
  CHECK(mesh.triangle_data() == with_data().triangle_data);
  CHECK(mesh.edge_data() == with_data().edge_data);
  CHECK(mesh.groups() == with_data().groups);
  CHECK(mesh.tets().size() == 2);
  check_equal(mesh.arrays(), with_data());
  check_equal(Mesh(mesh).arrays(), with_data());
  check_equal(std::move(mesh).take_arrays(), with_data());
}

TEST_CASE("a mesh tells who is in a group, however the group names them") {
  MeshArrays arrays = with_data();
  arrays.tet_labels = {5, 6};
  arrays.point_labels = {0, 8, 8, 0, 0};
  arrays.groups.push_back({.dimension = 3, .number = 5, .name = "by label"});
  arrays.groups.push_back({.dimension = 0, .number = 8, .name = "points by label"});
  arrays.groups.push_back({.dimension = 1, .number = 2, .name = "an edge", .parts = {4}});
  const Mesh mesh(arrays);
  using Numbers = std::vector<std::uint32_t>;
  const std::vector<Numbers> expected = {{1}, {1}, {0}, {4, 0}, {0}, {1, 2}, {0}};
  REQUIRE(mesh.groups().size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(mesh.members(mesh.groups()[i]) == expected[i]);
  }
}

TEST_CASE("mid-side nodes that contradict themselves are an error") {
  using Mid = std::vector<std::array<std::uint32_t, 3>>;
  MeshArrays arrays;
  arrays.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  arrays.tets = {{0, 1, 2, 3}};
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}) {
    const auto& [p, q] = std::pair(arrays.points[std::size_t(a)], arrays.points[std::size_t(b)]);
    arrays.mid_nodes.push_back(
        {std::uint32_t(a), std::uint32_t(b), std::uint32_t(4 + arrays.mid_nodes.size())});
    arrays.points.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
  }
  const Mesh sound(arrays);
  CHECK(sound.mid_nodes().size() == 6);
  CHECK(std::vector(sound.mid_nodes().begin(), sound.mid_nodes().end()) ==
        sound.arrays().mid_nodes);
  const auto complaint_of = [&](const Mid& more, std::size_t kept) {
    MeshArrays damaged = arrays;
    damaged.mid_nodes.resize(kept);
    damaged.mid_nodes.insert(damaged.mid_nodes.end(), more.begin(), more.end());
    return message_of([&] { Mesh(std::move(damaged)); });
  };
  CHECK(complaint_of({{1, 0, 4}}, 6).empty());
  CHECK(complaint_of({{1, 0, 9}}, 6) ==
        "mid_nodes: the edge (0, 1) has two nodes, 4 and 9: expected one, counted from 0");
  CHECK(complaint_of({}, 5) == "tets[0]: its edge (2, 3) has no mid-side node, counted from 0");
  CHECK(complaint_of({{2, 3, 8}}, 5) ==
        "mid_nodes: point 8, counted from 0, is the node of an edge and that of another edge: "
        "expected nodes of their own");
  CHECK(
      complaint_of({{2, 3, 1}}, 5) ==
      "mid_nodes: point 1, counted from 0, is the node of an edge and a vertex of a tet: expected "
      "nodes of their own");
  CHECK(complaint_of({{2, 3, 10}}, 5) ==
        "mid_nodes[5]: (2, 3, 10): no point 10, there are 10, counted from 0");
}

TEST_CASE("labels that are not given are 0, and points without any have no array of them") {
  MeshArrays arrays = two_tet_arrays();
  arrays.point_labels = {0, 0, 0, 0, 0};
  arrays.tet_labels = arrays.triangle_labels = arrays.edge_labels = {};
  const Mesh mesh(arrays);
  CHECK(mesh.point_labels().empty());
  CHECK(mesh.arrays().tet_labels == std::vector<std::int32_t>{0, 0});
  CHECK(mesh.arrays().triangle_labels == std::vector<std::int32_t>{0, 0});
  CHECK(mesh.arrays().edge_labels == std::vector<std::int32_t>{0});
}

TEST_CASE("a copy is a mesh of its own, and what was moved from is empty") {
  Mesh mesh(two_tet_arrays());
  Mesh copy = mesh;
  const Mesh moved = std::move(mesh);
  mesh = Mesh();
  check_equal(copy.arrays(), two_tet_arrays());
  check_equal(moved.arrays(), two_tet_arrays());
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

TEST_CASE("parts and data are one for each entity") {
  const auto damaged = [](const std::function<void(MeshArrays&)>& damage) {
    MeshArrays arrays = with_data();
    damage(arrays);
    return message_of([&] { Mesh(std::move(arrays)); });
  };
  CHECK(damaged([](MeshArrays&) {}).empty());
  CHECK(damaged([](MeshArrays& a) { a.tet_parts.pop_back(); }) == "tet_parts: 1 parts for 2 tets");
  CHECK(damaged([](MeshArrays& a) { a.triangle_parts = {1}; }).starts_with("triangle_parts: 1"));
  CHECK(damaged([](MeshArrays& a) { a.edge_parts = {1, 2}; }).starts_with("edge_parts: 2"));
  CHECK(damaged([](MeshArrays& a) { a.point_data[0].values = Doubles(14); }) ==
        "point_data[0]: 'velocity' has 14 numbers for 5 points, 3 for each");
  CHECK(damaged([](MeshArrays& a) { a.point_data[1].components = 2; }) ==
        "point_data[1]: 'mark' has 5 numbers for 5 points, 2 for each");
  CHECK(damaged([](MeshArrays& a) { a.tet_data[0].components = 0; }) ==
        "tet_data[0]: 'density' has 0 components");
  CHECK(damaged([](MeshArrays& a) { a.triangle_data[0].values = LongIntegers(); }) ==
        "triangle_data[0]: 'number' has 0 numbers for 2 triangles, 1 for each");
  CHECK(damaged([](MeshArrays& a) { a.edge_data[0].values = Singles(1); }) ==
        "edge_data[0]: 'width' has 1 numbers for 1 edges, 2 for each");
}

TEST_CASE("a group that contradicts itself is an error with its place") {
  const auto complaint_about = [](std::size_t i, const std::function<void(Group&)>& damage) {
    MeshArrays arrays = with_data();
    damage(arrays.groups[i]);
    return message_of([&] { Mesh(std::move(arrays)); });
  };
  CHECK(complaint_about(1, [](Group& group) { group.dimension = 4; }) ==
        "groups[1]: dimension 4, expected 0 to 3");
  CHECK(complaint_about(2, [](Group& group) { group.number = 1; }) ==
        "groups[2]: number 1 is that of groups[1]");
  CHECK(complaint_about(0, [](Group& group) { group.members = {0}; }) ==
        "groups[0]: it has parts and members");
  CHECK(complaint_about(1, [](Group& group) {
          group.members = {1, 2};
        }) == "groups[1].members[1]: no triangle 2, there are 2, counted from 0");
  CHECK(complaint_about(3, [](Group& group) {
          group.members = {4, 0, 4};
        }) == "groups[3].members[2]: point 4 twice, counted from 0");
}
