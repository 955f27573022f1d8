// SPDX-License-Identifier: MIT
// Meshes of MFEM: attributes and their names, nodes of second order, under two extensions.
#include "kernel/formats/mfem.h"

#include <doctest/doctest.h>

#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::string mfem_text() {
  return "MFEM mesh v1.3\n\n# made by hand\n\ndimension\n3\n\n"
         "elements\n3\n1 4 0 1 2 3\n2 4 1 2 3 4\n5 7 0 1 4 2 3\n\n"
         "attribute_sets\n2\n\"all of it\" 3 1 2 5\n\"nothing\" 1 17\n\n"
         "boundary\n2\n1 2 0 1 2\n7 3 0 1 4 2\n\n"
         "bdr_attribute_sets\n1\n\"wall\" 1 7\n\n"
         "vertices\n5\n3\n0 0 0\n1 0 0\n0 1 0\n0 0 1.5\n1 1 1\n\nmfem_mesh_end\n";
}

/// One tet whose edges have nodes, ordered as MFEM does.
std::string curved_text(std::string_view collection = "H1_3D_P2") {
  return "MFEM mesh v1.0\n\ndimension\n3\n\nelements\n1\n1 4 0 1 2 3\n\nboundary\n1\n3 2 0 1 2\n\n"
         "vertices\n4\n\nnodes\nFiniteElementSpace\nFiniteElementCollection: " +
         std::string(collection) +
         "\nVDim: 3\nOrdering: 1\n\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
         "0.5 0 0\n0 0.5 0\n0 0 0.5\n0.5 0.6 0\n0.5 0 0.5\n0 0.5 0.5\n";
}

MeshData read_mfem_text(const TempFolder& folder, std::string_view name, std::string_view content) {
  write_text(folder / name, content);
  return read_mesh(folder / name);
}

}  // namespace

TEST_CASE("a mesh of MFEM gives elements, attributes and their names, as .mfem and as .mesh") {
  const TempFolder folder;
  for (const std::string_view name : {"a.mfem", "a.mesh"}) {
    CAPTURE(name);
    const MeshData mesh = read_mfem_text(folder, name, mfem_text());
    CHECK(mesh.points[3] == Point(0, 0, 1.5));
    CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 1}, {{1, 2, 3, 4}, 2}});
    CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, 1}});
    REQUIRE(mesh.other_elements.size() == 2);
    CHECK(mesh.other_elements[0].vtk_type == 14);
    CHECK(mesh.groups ==
          std::vector<Group>{{3, 1, "all of it", {1, 2, 5}, {}}, {2, 1, "wall", {7}, {}}});
    CHECK(mesh.notes == std::vector<std::string>{"the set 'nothing' has no elements: not kept"});
  }
}

TEST_CASE("a mesh of MFEM comes back as one of MFEM under either name, with the same bytes") {
  const TempFolder folder;
  const MeshData mesh = read_mfem_text(folder, "a.mesh", mfem_text());
  CHECK(not_written(folder / "b.mesh", mesh).empty());
  write_mesh(folder / "b.mesh", mesh);
  write_mesh(folder / "b.mfem", mesh);
  CHECK(test::read_text(folder / "b.mesh") == test::read_text(folder / "b.mfem"));
  const MeshData again = read_mesh(folder / "b.mesh");
  CHECK(same_mesh(again, mesh));
  CHECK(again.groups == mesh.groups);
  CHECK(again.other_elements == mesh.other_elements);
  write_mesh(folder / "c.mesh", again);
  CHECK(test::read_text(folder / "b.mesh") == test::read_text(folder / "c.mesh"));
}

TEST_CASE("nodes of second order of MFEM are mid-side nodes, and are written as such") {
  const TempFolder folder;
  const MeshData mesh = read_mfem_text(folder, "a.mfem", curved_text());
  REQUIRE(mesh.tets.size() == 1);
  REQUIRE(mesh.mid_nodes.size() == 6);
  CHECK(mesh.points.size() == 10);
  std::size_t curved = 0;
  for (const auto& [a, b, node] : mesh.mid_nodes) {
    if (mesh.points[node] == (mesh.points[a] + mesh.points[b]) / 2) continue;
    ++curved;
    CHECK(std::min(a, b) == 1);
    CHECK(std::max(a, b) == 2);
  }
  CHECK(curved == 1);
  write_mesh(folder / "b.mfem", mesh);
  CHECK(test::read_text(folder / "b.mfem") == curved_text());
  const std::string linear = curved_text("Linear");
  CHECK(read_mfem_text(folder, "l.mfem", linear.substr(0, linear.find("0.5"))).points.size() == 4);
}

TEST_CASE("groups that are no whole attributes of MFEM are named when they are lost") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  mesh.required_vertices.clear();
  mesh.edges.clear();
  mesh.point_labels.clear();
  mesh.tets[1].label = mesh.tets[0].label = 3;
  mesh.triangles = {{{0, 2, 1}, 12}};
  mesh.groups = {{3, 1, "half", {}, {1}}, {3, 3, "whole", {}, {}}, {0, 1, "points", {}, {2}}};
  CHECK(not_written(folder / "a.mfem", mesh) ==
        std::vector<std::string>{
            "2 groups, with their names, are not kept: .mfem has names of whole attributes alone"});
  write_mesh(folder / "a.mfem", mesh);
  const MeshData again = read_mesh(folder / "a.mfem");
  REQUIRE(again.groups.size() == 1);
  CHECK(again.groups[0].name == "whole");
}

TEST_CASE("a mesh of MFEM with a byte changed or cut away never crashes") {
  const TempFolder folder;
  for (const std::string& text : {mfem_text(), curved_text()}) {
    write_text(folder / "a.mfem", text);
    change_each_byte(folder / "a.mfem", folder / "a.mfem");
    cut_at_each_byte(folder / "a.mfem");
  }
}

TEST_CASE("a bad mesh of MFEM is refused with line and reason") {
  const std::string good = mfem_text();
  const std::vector<BadFile> files = {
      {"NURBS", replaced(good, "MFEM mesh v1.3", "MFEM NURBS mesh v1.0"),
       "1: ", "expected 'MFEM mesh v1.0'"},
      {"plane", replaced(good, "dimension\n3", "dimension\n2"), "6: ", "expected dimension 3"},
      {"range", replaced(good, "2 4 1 2 3 4", "2 4 1 2 3 5"), "11: ", "'5' is out of range"},
      {"kind", replaced(good, "1 4 0 1 2 3", "1 2 0 1 2"), "10: ", "expected 4 (tetrahedron)"},
      {"name", replaced(good, "\"wall\"", "wall"), "26: ", "'wall' is not a name in quotes"},
      {"text", replaced(good, "0 0 1.5", "0 0 x"), "34: ", "'x' is not a number"},
      {"missing", replaced(good, "boundary\n2", "bundary\n2"), "19: ", "'bundary' is not expected"},
      {"cut", good.substr(0, good.find("boundary")), "", "no vertices follow the elements"},
      {"huge", replaced(good, "vertices\n5", "vertices\n500000000"), "", "cannot fit"},
      {"cubic", curved_text("H1_3D_P3"), "19: ", "nodes of 'H1_3D_P3' cannot be read"},
      {"discontinuous", curved_text("L2_T1_3D_P1"), "19: ", "cannot be read"},
      {"few nodes", replaced(curved_text(), "0 0.5 0.5\n", ""), "",
       "where a coordinate is expected"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.mfem", bad.content);
    const std::string error = error_of_reading(folder / "a.mfem");
    CHECK_MESSAGE(error.starts_with("a.mfem:" + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
