// SPDX-License-Identifier: MIT
// Meshes of Elmer: four files that belong together, parents of boundary elements, names.
#include "kernel/formats/elmer.h"

#include <doctest/doctest.h>

#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

struct ElmerFiles {
  std::string header = "11 4 5\n7\n202 1\n303 2\n306 1\n404 1\n504 2\n510 1\n605 1\n";
  std::string nodes =
      "1 -1 0 0 0\n2 -1 1 0 0\n3 -1 0 1 0\n4 -1 0 0 1\n5 -1 1 1 1\n6 -1 .5 0 0\n7 -1 .5 .5 0\n"
      "8 -1 0 .5 0\n9 -1 0 0 .5\n10 -1 .5 0 .5\n11 -1 0 .5 .5\n";
  std::string elements =
      "1 1 504 1 2 3 4\n2 2 504 2 3 4 5\n3 2 510 1 2 3 4 6 7 8 9 10 11\n4 2 605 1 2 5 4 3\n";
  std::string boundary =
      "1 5 1 2 303 2 3 4\n2 6 1 0 303 1 3 2\n3 6 3 0 306 1 2 3 6 7 8\n4 7 4 0 404 1 2 5 4\n"
      "5 9 0 0 202 1 2\n";
  std::string names =
      "! ----- names for bodies -----\n$ steel = 1\n"
      "! ----- names for boundaries -----\n$ wall = 6\n$ rim = 9\n";

  void write(const TempFolder& folder) const {
    write_text(folder / "mesh.header", header);
    write_text(folder / "mesh.nodes", nodes);
    write_text(folder / "mesh.elements", elements);
    write_text(folder / "mesh.boundary", boundary);
    write_text(folder / "mesh.names", names);
  }
};

ElmerFiles good() {
  return {};
}

}  // namespace

TEST_CASE("the files of Elmer give bodies and boundaries with labels and names") {
  const TempFolder folder;
  good().write(folder);
  const MeshData mesh = read_mesh(folder / "mesh.header");
  CHECK(mesh.points.size() == 11);
  CHECK(mesh.points[9] == Point(0.5, 0, 0.5));
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 1}, {{1, 2, 3, 4}, 2}});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{1, 2, 3}, 5}, {{0, 2, 1}, 6}});
  CHECK(mesh.edges == std::vector<MeshData::Edge>{{{0, 1}, 9}});
  REQUIRE(mesh.other_elements.size() == 4);
  CHECK(mesh.other_elements[0].vtk_type == 24);
  CHECK(mesh.other_elements[1].vtk_type == 14);
  CHECK(mesh.other_elements[2].vtk_type == 22);
  CHECK(mesh.other_elements[3].vtk_type == 9);
  const std::vector<Group> groups = {
      {3, 1, "steel", {}, {}}, {2, 6, "wall", {}, {}}, {1, 9, "rim", {}, {}}};
  CHECK(mesh.groups == groups);
  CHECK(notes_but_of_orders(mesh).empty());
}

TEST_CASE("what the files of Elmer hold survives writing, with parents found from the volumes") {
  const TempFolder folder;
  ElmerFiles files = good();
  // Nobody believes the parents of a file.
  files.boundary = replaced(files.boundary, "1 5 1 2 303", "1 5 9 9 303");
  files.elements = replaced(files.elements, "3 2 510 1 2 3 4 6", "3 2 510 1 2 3 5 6");
  files.write(folder);
  const MeshData mesh = read_mesh(folder / "mesh.header");
  const TempFolder other;
  CHECK(not_written(other / "mesh.header", mesh).empty());
  write_mesh(other / "mesh.header", mesh);
  CHECK(other.entries() == 5);
  const MeshData again = read_mesh(other / "mesh.header");
  CHECK(same_mesh(again, mesh));
  CHECK(again.other_elements == mesh.other_elements);
  CHECK(again.groups == mesh.groups);
  const std::string boundary = test::read_text(other / "mesh.boundary");
  CHECK(boundary.starts_with("1 5 1 2 303 2 3 4\n"));
  CHECK(boundary.find("\n4 7 4 0 404 1 2 5 4\n5 9 0 0 202 1 2\n") != std::string::npos);
}

TEST_CASE("a triangle of Elmer whose only volume is in front of it has it for its first parent") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{{0, 1, 2, 3}, 1}};
  mesh.triangles = {{{0, 1, 2}, 1}};
  write_mesh(folder / "mesh.header", mesh);
  CHECK(test::read_text(folder / "mesh.boundary") == "1 1 1 0 303 1 2 3\n");
}

TEST_CASE("nodes of Elmer may have numbers with gaps, which are not kept") {
  const TempFolder folder;
  ElmerFiles files = good();
  files.nodes = replaced(files.nodes, "5 -1 1 1 1", "50 -1 1 1 1");
  files.elements = replaced(files.elements, "2 3 4 5\n", "2 3 4 50\n");
  files.elements = replaced(files.elements, "1 2 5 4 3", "1 2 50 4 3");
  files.boundary = replaced(files.boundary, "1 2 5 4", "1 2 50 4");
  files.write(folder);
  const MeshData mesh = read_mesh(folder / "mesh.header");
  CHECK(mesh.tets[1].vertices[3] == 4);
  CHECK(notes_but_of_orders(mesh) == std::vector<std::string>{"the numbers of nodes are not kept"});
}

TEST_CASE("names of Elmer that are there already are written anew, and other lines noted") {
  const TempFolder folder;
  ElmerFiles files = good();
  files.names += "[Solver]\n";
  files.write(folder);
  MeshData mesh = read_mesh(folder / "mesh.header");
  CHECK(notes_but_of_orders(mesh) ==
        std::vector<std::string>{"1 lines of mesh.names are not kept: they give no name"});
  mesh.groups.clear();
  write_mesh(folder / "mesh.header", mesh);
  CHECK(test::read_text(folder / "mesh.names").find('$') == std::string::npos);
}

TEST_CASE("no file of Elmer is changed if one of them cannot be written") {
  const TempFolder folder;
  good().write(folder);
  const MeshData mesh = read_mesh(folder / "mesh.header");
  std::filesystem::remove(folder / "mesh.boundary");
  std::filesystem::create_directory(folder / "mesh.boundary");
  write_text(folder / "mesh.nodes", "old");
  CHECK_THROWS_AS(write_mesh(folder / "mesh.header", mesh), Error);
  CHECK(test::read_text(folder / "mesh.nodes") == "old");
  CHECK(folder.entries() == 5);
}

TEST_CASE("files of Elmer with a byte changed or cut away never crash") {
  const TempFolder folder;
  good().write(folder);
  for (const char* name :
       {"mesh.header", "mesh.nodes", "mesh.elements", "mesh.boundary", "mesh.names"}) {
    change_each_byte(folder / "mesh.header", folder / name);
  }
  for (const char* name : {"mesh.nodes", "mesh.elements", "mesh.boundary", "mesh.names"}) {
    const std::string content = test::read_text(folder / name);
    for (std::size_t size = content.size(); size-- > 0;) {
      std::filesystem::resize_file(folder / name, size);
      CHECK(reads_soundly(folder / "mesh.header"));
    }
    write_text(folder / name, content);
  }
  cut_at_each_byte(folder / "mesh.header");
}

TEST_CASE("a tet of Elmer is located by its line") {
  const TempFolder folder;
  good().write(folder);
  CHECK(locate_tet(folder / "mesh.header", 1).ends_with("mesh.elements:2"));
}

TEST_CASE("bad files of Elmer are refused with file, line and reason") {
  struct Bad {
    std::string ElmerFiles::*file;
    std::string_view what, with, place, reason;
  };
  const std::vector<Bad> cases = {
      {&ElmerFiles::header, "11 4 5", "1000000000 4 5",
       "mesh.nodes:1: ", "1000000000 nodes cannot fit"},
      {&ElmerFiles::header, "11 4 5", "11 1000000000 5",
       "mesh.elements:1: ", "elements cannot fit"},
      {&ElmerFiles::header, "11 4 5", "11 4 1000000000",
       "mesh.boundary:1: ", "elements cannot fit"},
      {&ElmerFiles::header, "11 4 5\n7", "11 4 5\n1000000000",
       "mesh.header:2: ", "types cannot fit"},
      {&ElmerFiles::header, "11 4 5", "11 5 5", "mesh.elements:5: ", "the file ends"},
      {&ElmerFiles::header, "11 4 5", "11 3 5",
       "mesh.elements:4: ", "'4' follows the last element"},
      {&ElmerFiles::header, "504 2", "504 3",
       "mesh.header:1: ", "hold 2 elements of type 504: expected 3"},
      {&ElmerFiles::header, "605 1\n", "605 1\n3", "mesh.header:10: ", "'3' follows the last type"},
      {&ElmerFiles::nodes, "5 -1 1 1 1", "4 -1 1 1 1",
       "mesh.nodes:5: ", "'4' of a node appears for the second"},
      {&ElmerFiles::nodes, "5 -1 1 1 1", "5 -1 1 a 1", "mesh.nodes:5: ", "'a' is not a number"},
      {&ElmerFiles::nodes, "5 -1 1 1 1", "5 -1 1 inf 1", "mesh.nodes:5: ", "not a finite number"},
      {&ElmerFiles::elements, "504 2 3 4 5", "504 2 3 4 12",
       "mesh.elements:2: ", "'12' is not the number of a node"},
      {&ElmerFiles::elements, "504 2 3 4 5", "303 2 3 4",
       "mesh.elements:2: ", "elements of type 303 cannot be read here"},
      {&ElmerFiles::elements, "2 2 504", "2 9999999999 504",
       "mesh.elements:2: ", "expected the number of a body"},
      {&ElmerFiles::boundary, "202 1 2", "504 1 2",
       "mesh.boundary:5: ", "elements of type 504 cannot be read here"},
      {&ElmerFiles::names, "wall = 6", "wall", "mesh.names:4: ", "expected '$ name = number'"},
      {&ElmerFiles::names, "rim = 9", "rim = 6",
       "mesh.names:5: ", "the number '6' has a second name"},
  };
  const TempFolder folder;
  for (const Bad& bad : cases) {
    CAPTURE(bad.with);
    ElmerFiles files = good();
    files.*bad.file = replaced(files.*bad.file, bad.what, bad.with);
    files.write(folder);
    const std::string error = error_of_reading(folder / "mesh.header");
    CHECK_MESSAGE(error.starts_with(bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
