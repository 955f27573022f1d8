// SPDX-License-Identifier: MIT
#include "kernel/formats/degenerate.h"

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include <doctest/doctest.h>

#include "kernel/formats/mesh_io.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::formats;
using namespace tetmend::test;

namespace {

/// Two tets; then one with a vertex twice and the first once more.
MeshData degenerate_mesh() {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tets = {{{0, 1, 2, 3}, 1}, {{1, 2, 2, 3}, 1}, {{1, 2, 3, 4}, 1}, {{3, 2, 1, 0}, 1}};
  mesh.triangles = {{{0, 2, 1}, 3}, {{0, 0, 1}, 3}};
  mesh.edges = {{{4, 4}, 2}, {{0, 1}, 2}};
  return mesh;
}

template <class Element>
bool has_vertex_twice(const std::vector<Element>& elements) {
  return std::any_of(elements.begin(), elements.end(), [](const Element& element) {
    auto v = element.vertices;
    std::sort(v.begin(), v.end());
    return std::adjacent_find(v.begin(), v.end()) != v.end();
  });
}

bool tells(const MeshData& mesh, std::string_view text) {
  return std::any_of(mesh.notes.begin(), mesh.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("degenerate and repeated elements are dropped with a note, whatever the format") {
  const TempFolder folder;
  for (const std::string name :
       {"a.mesh", "a.meshb", "a.node", "a.vtk", "a.vtu", "a.msh", "a.inp", "a.su2", "a.vol",
        "a.bdf", "mesh.header", "a.unv", "a.mfem", "a.k", "a.feb", "a.med"}) {
    CAPTURE(name);
    write_mesh(folder / name, degenerate_mesh());
    const MeshData mesh = read_mesh(folder / name);
    CHECK(mesh.tets.size() == 2);
    CHECK_FALSE(has_vertex_twice(mesh.tets));
    CHECK_FALSE(has_vertex_twice(mesh.triangles));
    CHECK_FALSE(has_vertex_twice(mesh.edges));
    CHECK(tells(mesh, "tet 2 (vertices 2 3 3 4) has a vertex twice: dropped"));
    CHECK(tells(mesh, "tet 4 is tet 1 again: dropped"));
    for (const std::string& note : mesh.notes) {
      if (!tells_of_dropped(note)) continue;
      CHECK(note.starts_with((folder / "").string()));  // the place in the file
      CHECK(note.find(": ") < note.find(" (vertices "));
    }
  }
}

TEST_CASE("the note on elements that are dropped has the line of the first") {
  const TempFolder folder;
  write_text(folder / "a.mesh",
             "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
             "1 1 1 0\nTetrahedra 5\n1 2 3 4 1\n2 3 3 4 1\n4 4 3 1 1\n2 3 4 5 1\n4 3 2 1 1\nEnd\n");
  const std::string file = (folder / "a.mesh").string();
  CHECK(read_mesh(folder / "a.mesh").notes ==
        std::vector<std::string>{file + ":11: 2 tets have a vertex twice, the first is tet 2 "
                                        "(vertices 2 3 3 4): dropped",
                                 file + ":14: tet 5 is tet 1 again: dropped"});
}

TEST_CASE("the note on triangles and edges that are dropped has the line of the first, too") {
  const TempFolder folder;
  const std::string tet_of_gmsh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
      "$EndNodes\n$Elements\n5\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 2 2\n3 1 2 1 1 1 2\n4 1 2 1 1 3 3\n"
      "5 4 2 1 1 1 2 3 4\n$EndElements\n";
  write_text(folder / "a.msh", tet_of_gmsh);
  write_text(
      folder / "a.mesh",
      "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
      "Triangles 2\n1 2 3 1\n1 2 2 1\nEdges 2\n1 2 1\n3 3 1\nTetrahedra 1\n1 2 3 4 1\nEnd\n");
  write_text(folder / "a.node", "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
  write_text(folder / "a.ele", "1 4 0\n1 1 2 3 4\n");
  write_text(folder / "a.face", "2 1\n1 1 2 3 5\n2 1 2 2 5\n");
  write_text(folder / "a.edge", "2 1\n1 1 2 5\n2 3 3 5\n");
  const auto has_line = [&](const std::string& name, const std::string& place,
                            std::string_view what) {
    const MeshData mesh = read_mesh(folder / name);
    return tells(mesh, (folder / place).string() + ": " + std::string(what));
  };
  CHECK(has_line("a.msh", "a.msh:14", "triangle 2 (vertices 1 2 2) has a vertex twice: dropped"));
  CHECK(has_line("a.msh", "a.msh:16", "edge 2 (vertices 3 3) has a vertex twice: dropped"));
  CHECK(has_line("a.mesh", "a.mesh:10", "triangle 2 (vertices 1 2 2) has a vertex twice: dropped"));
  CHECK(has_line("a.mesh", "a.mesh:13", "edge 2 (vertices 3 3) has a vertex twice: dropped"));
  CHECK(has_line("a.node", "a.face:3", "triangle 2 (vertices 1 2 2) has a vertex twice: dropped"));
  CHECK(has_line("a.node", "a.edge:3", "edge 2 (vertices 3 3) has a vertex twice: dropped"));
}

TEST_CASE("what belongs to a dropped element goes with it, and the rest keeps what it has") {
  MeshData mesh = degenerate_mesh();
  mesh.tet_parts = {5, 6, 7, 8};
  mesh.tet_numbers = {10, 20, 30, 40};
  mesh.tet_data = {{"a", 2, std::vector<double>{1, 1, 2, 2, 3, 3, 4, 4}}};
  mesh.groups = {{3, 1, "some", {}, {1, 2, 3}}, {1, 1, "lines", {}, {0, 1}}};
  CHECK(drop_degenerate(mesh) == std::vector<std::uint32_t>{1, 3});
  CHECK(mesh.tet_parts == std::vector<Label>{5, 7});
  CHECK(mesh.tet_numbers == std::vector<std::int64_t>{10, 30});
  CHECK(std::get<std::vector<double>>(mesh.tet_data[0].values) == std::vector<double>{1, 1, 3, 3});
  CHECK(mesh.groups[0].members == std::vector<std::uint32_t>{1});
  CHECK(mesh.groups[1].members == std::vector<std::uint32_t>{0});
  CHECK(tells(mesh, "tet 40 is tet 10 again: dropped"));
}

TEST_CASE("a tet of second order with a corner twice goes, a collapsed hexahedron stays") {
  MeshData mesh;
  mesh.points.resize(30, Point::Zero());
  mesh.other_elements.push_back({24, 10, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {1}, {}, {}, {}});
  for (const std::uint32_t v : {0, 1, 1, 3, 10, 11, 12, 13, 14, 15}) {
    mesh.other_elements[0].vertices.push_back(v);
  }
  mesh.other_elements[0].labels.push_back(1);
  mesh.other_elements.push_back({12, 8, {0, 1, 2, 2, 20, 21, 22, 22}, {1}, {}, {}, {}});
  CHECK(drop_degenerate(mesh) == std::vector<std::uint32_t>{1});
  CHECK(mesh.other_elements[0].labels.size() == 1);
  CHECK(mesh.other_elements[0].vertices.size() == 10);
  CHECK(mesh.other_elements[1].labels.size() == 1);
}

TEST_CASE("of tets in any order the repeated ones are those that a set finds") {
  std::mt19937 random(7);
  for (const std::uint32_t points : {5U, 9U, 40U, 3000U}) {
    MeshData mesh;
    mesh.points.resize(points, Point::Zero());
    std::set<std::array<std::uint32_t, 4>> known;
    std::vector<std::uint32_t> expected;
    for (std::uint32_t t = 0; t < 20000; ++t) {
      std::array<std::uint32_t, 4> v{};
      // Neighbours, as in most meshes, and a fan around the first point.
      const std::uint32_t around = t % 3 == 0 ? 0 : static_cast<std::uint32_t>(random() % points);
      for (std::uint32_t& corner : v) {
        corner = (around + static_cast<std::uint32_t>(random() % 12)) % points;
      }
      if (t % 7 == 0 && t > 0) v = mesh.tets[random() % t].vertices;
      std::shuffle(v.begin(), v.end(), random);
      mesh.tets.push_back({v, 1});
      std::sort(v.begin(), v.end());
      const bool is_collapsed = std::adjacent_find(v.begin(), v.end()) != v.end();
      if (is_collapsed || !known.insert(v).second) expected.push_back(t);
    }
    CHECK(drop_degenerate(mesh) == expected);
    CHECK(mesh.tets.size() == known.size());
  }
}

TEST_CASE("where a tet stands in the file counts those that were dropped before it") {
  const TempFolder folder;
  write_mesh(folder / "a.mesh", degenerate_mesh());
  const std::string first = locate_tet(folder / "a.mesh", 0);
  const std::string second = locate_tet(folder / "a.mesh", 1);
  const auto line = [](const std::string& place) {
    return std::stoi(place.substr(place.rfind(':') + 1));
  };
  CHECK(line(second) == line(first) + 2);
}

TEST_CASE("where a tet of second order stands in the file counts those that were dropped, too") {
  const TempFolder folder;
  MeshData mesh;
  for (int i = 0; i < 26; ++i) mesh.points.emplace_back(i, i % 3, i % 5);
  OtherElements tets{24, 10, {}, {1, 1, 1}, {}, {}, {}};
  for (std::uint32_t v = 0; v < 10; ++v) tets.vertices.push_back(v);
  for (const std::uint32_t v : {0, 1, 1, 3, 10, 11, 12, 13, 14, 15}) tets.vertices.push_back(v);
  for (std::uint32_t v = 16; v < 26; ++v) tets.vertices.push_back(v);
  mesh.other_elements = {tets};
  mesh.variant = "2.2 ASCII";
  write_mesh(folder / "a.msh", mesh);
  const MeshData read = read_mesh(folder / "a.msh");
  REQUIRE(read.tets.size() == 2);
  const auto line = [](const std::string& place) {
    return std::stoi(place.substr(place.rfind(':') + 1));
  };
  CHECK(line(locate_tet(folder / "a.msh", 1)) == line(locate_tet(folder / "a.msh", 0)) + 2);
}

TEST_CASE("a file all of whose tets have a vertex twice is refused") {
  const TempFolder folder;
  write_text(folder / "a.msh",
             "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"
             "$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 3\n$EndElements\n");
  CHECK(
      error_of_reading(folder / "a.msh").find("no tet is left: each of them has a vertex twice") !=
      std::string::npos);
}
