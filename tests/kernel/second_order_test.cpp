// SPDX-License-Identifier: MIT
// Elements of second order to mid-side nodes and back.
#include "kernel/second_order.h"

#include <string>

#include <doctest/doctest.h>

#include "contract/zoo.h"
#include "kernel/error.h"
#include "tests/support/second_order.h"

using namespace tetmend;

namespace {

MeshData sample() {
  MeshData mesh = test::second_order(contract::kuhn_cube(2, 0.1, 1), 0.1);
  const auto& v = mesh.tets[0].vertices;
  mesh.triangles = {{{v[0], v[1], v[2]}, 4}, {{v[1], v[2], v[3]}, 5}};
  mesh.edges = {{{v[2], v[3]}, 6}};
  std::vector<double> values;
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    mesh.tets[i].label = static_cast<Label>(i % 3);
    mesh.tet_parts.push_back(static_cast<Label>(i % 2));
    mesh.tet_numbers.push_back(static_cast<std::int64_t>(100 + i));
    values.push_back(0.5 * static_cast<double>(i));
  }
  mesh.tet_data = {{"height", 1, values}};
  return mesh;
}

std::string second_order_error(MeshData mesh) {
  try {
    take_second_order(mesh);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("what writers get of a mesh of second order comes back from readers") {
  const MeshData mesh = sample();
  MeshData given = with_second_order(mesh);
  CHECK(given.tets.empty());
  CHECK(given.triangles.empty());
  CHECK(given.edges.empty());
  CHECK(given.mid_nodes.empty());
  REQUIRE(given.other_elements.size() == 3);
  CHECK(given.other_elements[0].vtk_type == 24);
  CHECK(given.other_elements[0].numbers == mesh.tet_numbers);
  CHECK(given.other_elements[0].parts == mesh.tet_parts);
  CHECK(given.other_elements[0].data == mesh.tet_data);
  take_second_order(given);
  CHECK(given.tets == mesh.tets);
  CHECK(given.triangles == mesh.triangles);
  CHECK(given.edges == mesh.edges);
  CHECK(given.tet_parts == mesh.tet_parts);
  CHECK(given.tet_numbers == mesh.tet_numbers);
  CHECK(given.tet_data == mesh.tet_data);
  CHECK(given.points == mesh.points);
  CHECK(given.other_elements.empty());
  const MidNodes then(mesh.mid_nodes);
  const MidNodes now(given.mid_nodes);
  CHECK(given.mid_nodes.size() == mesh.mid_nodes.size());
  for (const auto& [a, b, node] : mesh.mid_nodes) CHECK(now.of(b, a) == node);
  CHECK(now.of(mesh.mid_nodes[0][2], 0) == kNoMidNode);
}

TEST_CASE("triangles that a group names one by one stay marks of first order") {
  MeshData mesh = sample();
  mesh.groups = {{2, 0, "load", {}, {1}}};
  const MeshData given = with_second_order(mesh);
  CHECK(given.triangles == std::vector<MeshData::Triangle>{mesh.triangles[1]});
  CHECK(given.groups[0].members == std::vector<std::uint32_t>{0});
}

TEST_CASE("a format without second order gets the mesh of the vertices") {
  MeshData mesh = sample();
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    mesh.point_numbers.push_back(static_cast<std::int64_t>(10 + i));
  }
  mesh.required_vertices = {mesh.mid_nodes[3][2], mesh.tets[5].vertices[2]};
  const MeshData straight = without_mid_nodes(mesh);
  CHECK(straight.points.size() == mesh.points.size() - mesh.mid_nodes.size());
  CHECK(straight.mid_nodes.empty());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t now = straight.tets[t].vertices[k];
      CHECK(straight.points[now] == mesh.points[mesh.tets[t].vertices[k]]);
      CHECK(straight.point_numbers[now] == mesh.point_numbers[mesh.tets[t].vertices[k]]);
    }
  }
  CHECK(straight.required_vertices == std::vector<std::uint32_t>{straight.tets[5].vertices[2]});
}

TEST_CASE("nodes that make no sense are refused") {
  const MeshData good = with_second_order(sample());
  MeshData bad = good;
  std::swap(bad.other_elements[0].vertices[5], bad.other_elements[0].vertices[6]);
  CHECK(second_order_error(bad).find("has two nodes") != std::string::npos);
  bad = good;
  for (OtherElements& others : bad.other_elements) {
    for (std::uint32_t& v : others.vertices) {
      if (v == good.other_elements[0].vertices[7]) v = good.other_elements[0].vertices[3];
    }
  }
  CHECK(second_order_error(bad).find("a vertex of a tet") != std::string::npos);
}

TEST_CASE("in a mesh of both orders the tets of second order pass as they are") {
  MeshData mesh = with_second_order(sample());
  mesh.tets = {{{0, 1, 2, 3}, 0}};
  const auto others = mesh.other_elements;
  take_second_order(mesh);
  CHECK(mesh.other_elements == others);
  CHECK(mesh.mid_nodes.empty());
  const std::string curved = std::to_string(others[0].labels.size());
  const std::string all = std::to_string(others[0].labels.size() + 1);
  CHECK(mesh.notes == std::vector<std::string>{"of " + all + " tets " + curved +
                                               " are of second order: they stay as they are, and "
                                               "where they are"});
  MeshData pure = with_second_order(sample());
  take_second_order(pure);
  CHECK(pure.notes.empty());
}
