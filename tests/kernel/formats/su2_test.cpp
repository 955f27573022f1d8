// SPDX-License-Identifier: MIT
// SU2's files: markers and their names, other elements, what is kept word for word.
#include "kernel/formats/su2.h"

#include <doctest/doctest.h>

#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Two tets, a pyramid, a tet of second order; three markers, one of them without elements.
std::string su2_text() {
  return "% made by hand\n"
         "NDIME= 3\n"
         "NELEM = 4 % of them\n"
         "10 0 1 2 3 0\n"
         "10\t1 2 3 4\n"
         "14 0 1 2 4 3 7\n"
         "24 0 1 2 3 5 6 7 8 9 10 9\n"
         "% a comment = no keyword\n"
         "NPOIN=11 11\n"
         "0 0 0 0\n1 0 0 1\n0 1 0 2\n0 0 1\n1 1 1 4\n0.5 0 0\n.5 .5 0\n0 0.5 0\n0 0 0.5\n"
         "0.5 0 0.5\n0 0.5 1.5D-1\n"
         "NMARK= 3\n"
         "MARKER_TAG= the_wing\n"
         "MARKER_ELEMS= 2\n"
         "5 0 1 2\n"
         "9 0 1 4 3\n"
         "MARKER_TAG= far %field\n"
         "MARKER_ELEMS= 1\n"
         "5 1 2 3 0\n"
         "MARKER_TAG= empty\n"
         "MARKER_ELEMS= 0\n"
         "FFD_NBOX= 1\n"
         "FFD_TAG= 0\n"
         "FFD_CORNER_POINTS= 2\n"
         "0 0 0\n"
         "1 1 1 % last\n"
         "FFD_SURFACE_POINTS= 0\n";
}

bool same_su2_extras(const MeshData& a, const MeshData& b) {
  return a.groups == b.groups && a.other_elements == b.other_elements && a.deck == b.deck &&
         a.variant == b.variant;
}

}  // namespace

TEST_CASE("an SU2 file gives tets, other elements and markers as named groups") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.su2", su2_text());
  CHECK(mesh.points.size() == 11);
  CHECK(mesh.points[10] == Point(0, 0.5, 0.15));
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 0}, {{1, 2, 3, 4}, 0}});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, 1}, {{1, 2, 3}, 2}});
  REQUIRE(mesh.other_elements.size() == 3);
  CHECK(mesh.other_elements[0].vtk_type == 14);
  CHECK(mesh.other_elements[0].vertices == std::vector<std::uint32_t>{0, 1, 2, 4, 3});
  CHECK(mesh.other_elements[1].vtk_type == 24);
  CHECK(mesh.other_elements[2].vtk_type == 9);
  CHECK(mesh.other_elements[2].labels == std::vector<Label>{1});
  const std::vector<Group> groups = {
      {2, 1, "the_wing", {}, {}}, {2, 2, "far", {}, {}}, {2, 3, "empty", {}, {}}};
  CHECK(mesh.groups == groups);
  const std::vector<std::string> deck = {"FFD_NBOX= 1\n", "FFD_TAG= 0\n",
                                         "FFD_CORNER_POINTS= 2\n0 0 0\n1 1 1 % last\n",
                                         "FFD_SURFACE_POINTS= 0\n"};
  CHECK(mesh.deck == deck);
  CHECK(notes_but_of_orders(mesh).empty());
}

TEST_CASE("what an SU2 file holds survives writing, and the second time with the same bytes") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.su2", su2_text());
  CHECK(not_written(folder / "b.su2", mesh).empty());
  write_mesh(folder / "b.su2", mesh);
  const MeshData again = read_mesh(folder / "b.su2");
  CHECK(same_mesh(again, mesh));
  CHECK(same_su2_extras(again, mesh));
  write_mesh(folder / "c.su2", again);
  CHECK(test::read_text(folder / "b.su2") == test::read_text(folder / "c.su2"));
}

TEST_CASE("labels are the tags of SU2 markers that have no name, and come back if all are such") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  write_mesh(folder / "a.su2", mesh);
  CHECK(read_mesh(folder / "a.su2").triangles == mesh.triangles);
  mesh.groups = {{2, 0, "the wall", {}, {}}};
  write_mesh(folder / "a.su2", mesh);
  const MeshData named = read_mesh(folder / "a.su2");
  CHECK(named.groups[0].name == "the_wall");
  CHECK(named.groups[1].name == "12");
  CHECK(named.triangles[0].label == 1);
  CHECK(named.triangles[0].vertices == mesh.triangles[2].vertices);
}

TEST_CASE("groups that are whole labels give SU2 markers their names, whatever tells them apart") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  mesh.required_vertices.clear();
  mesh.triangles = {{{0, 2, 1}, 5}, {{3, 0, 1}, 5}, {{4, 3, 2}, 6}};
  mesh.triangle_parts = {1, 2, 3};
  mesh.groups = {{2, 8, "half of one", {2}, {}},
                 {2, 9, "five", {1, 2}, {}},
                 {2, 10, "six", {}, {2}},
                 {2, 11, "both", {1, 2, 3}, {}},
                 {3, 1, "volume", {}, {0}}};
  write_mesh(folder / "a.su2", mesh);
  const MeshData again = read_mesh(folder / "a.su2");
  REQUIRE(again.groups.size() == 2);
  CHECK(again.groups[0].name == "five");
  CHECK(again.groups[1].name == "six");
  const std::vector<std::string> lost = {
      "2 edges are not kept: .su2 has no place for them",
      "2 labels of tets are not kept: .su2 has no place for them",
      "4 labels of points are not kept: .su2 has no place for them",
      "3 groups, with their names, are not kept: .su2 has no place for them"};
  CHECK(not_written(folder / "a.su2", mesh) == lost);
}

TEST_CASE("names of SU2 markers are words and differ") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  mesh.groups = {{2, 12, "a b=c%", {}, {}}, {2, 0, "a b=c ", {}, {}}};
  write_mesh(folder / "a.su2", mesh);
  const MeshData again = read_mesh(folder / "a.su2");
  CHECK(again.groups[0].name == "a_b_c_");
  CHECK(again.groups[1].name == "a_b_c__2");
}

TEST_CASE("surface points of an FFD box of an SU2 file are dropped with a note") {
  const TempFolder folder;
  const MeshData mesh =
      read_as(folder, "a.su2",
              replaced(su2_text(), "FFD_SURFACE_POINTS= 0\n",
                       "FFD_SURFACE_POINTS= 2\nthe_wing 0 0.1 0.2 0.3\nthe_wing 1 0.1 0.2 0.3\n"));
  CHECK(mesh.deck.back() == "FFD_SURFACE_POINTS= 0\n");
  CHECK(notes_but_of_orders(mesh) ==
        std::vector<std::string>{
            "the surface points of an FFD box are not kept: SU2 finds them anew"});
}

TEST_CASE("the deck of an SU2 file is of no use to another format, and that is said") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.su2", su2_text());
  CHECK(not_written(folder / "a.vtu", mesh).back() ==
        "4 pieces of a deck, all that is no mesh, are not kept: .vtu has no place for them");
  MeshData other = mesh;
  other.variant = "4.1 ASCII";
  write_mesh(folder / "b.su2", other);
  CHECK(read_mesh(folder / "b.su2").deck.empty());
}

TEST_CASE("an SU2 file with a byte changed or cut away never crashes") {
  const TempFolder folder;
  write_text(folder / "a.su2", su2_text());
  change_each_byte(folder / "a.su2", folder / "a.su2");
  cut_at_each_byte(folder / "a.su2");
}

TEST_CASE("a tet of an SU2 file is located by its line") {
  const TempFolder folder;
  write_text(folder / "a.su2", su2_text());
  CHECK(locate_tet(folder / "a.su2", 1).ends_with("a.su2:5"));
}

TEST_CASE("a bad SU2 file is refused with line and reason") {
  const std::string good = su2_text();
  const std::vector<BadFile> files = {
      {"other", "solid x\n", "1: ", "'solid x' is not expected here: expected a keyword and '='"},
      {"plane", replaced(good, "NDIME= 3", "NDIME= 2"), "2: ", "expected NDIME= 3"},
      {"zones", "NZONE= 2\n" + good, "1: ", "several zones cannot be read"},
      {"range", replaced(good, "10\t1 2 3 4", "10\t1 2 3 11"),
       "5: ", "'11' is out of range: expected a vertex number, 0 to 10"},
      {"type", replaced(good, "10\t1 2 3 4", "5\t1 2 3 4"),
       "5: ", "elements of type 5 cannot be read here: expected 10"},
      {"type", replaced(good, "5 0 1 2\n", "3 0 1\n"),
       "24: ", "elements of type 3 cannot be read here: expected 5"},
      {"text", replaced(good, "1 1 1 4", "1 1 a 4"), "14: ", "'a' is not a number"},
      {"infinite", replaced(good, "1 1 1 4", "1 1 1e999 4"), "14: ", "is not a finite number"},
      {"order", replaced(good, "1 1 1 4", "1 1 1 5"),
       "14: ", "'5' is out of range: expected the place of the point in the list, 4 to 4"},
      {"few", replaced(good, "NELEM = 4", "NELEM = 5"), "9: ", "'NPOIN=11' is not an integer"},
      {"many", replaced(good, "NELEM = 4", "NELEM = 3"), "7: ", "expected a keyword"},
      {"huge", replaced(good, "NELEM = 4", "NELEM = 1000000000"),
       "3: ", "1000000000 elements cannot fit"},
      {"huge", replaced(good, "NPOIN=11", "NPOIN=1000000000"),
       "9: ", "1000000000 points cannot fit"},
      {"huge", replaced(good, "MARKER_ELEMS= 2", "MARKER_ELEMS= 1000000000"),
       "23: ", "1000000000 elements cannot fit"},
      {"markers", replaced(good, "NMARK= 3", "NMARK= 2"), "", "3 markers are complete: expected 2"},
      {"no tag", replaced(good, "MARKER_TAG= the_wing", "MARKER_TAG="),
       "22: ", "'MARKER_TAG' says nothing"},
      {"same tag", replaced(good, "MARKER_TAG= far", "MARKER_TAG= the_wing"),
       "26: ", "the marker 'the_wing' appears for the second time"},
      {"no marker", replaced(good, "MARKER_TAG= far %field\n", ""), "26: ", "expected MARKER_TAG="},
      {"no elements", replaced(good, "MARKER_ELEMS= 0\n", ""), "", "2 markers are complete"},
      {"parallel", replaced(good, "FFD_TAG= 0", "SEND_RECV= 1"),
       "32: ", "'SEND_RECV' cannot be read"},
      {"twice", good + "NPOIN= 0\n", "", "'NPOIN' appears for the second time"},
      {"no points", replaced(good, "NPOIN=11", "NPOI=11"), "4: ", "'0' is out of range"},
      {"no markers", replaced(good, "NMARK=", "NMARQ="), "", "the keyword NMARK is missing"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.su2", bad.content);
    const std::string error = error_of_reading(folder / "a.su2");
    CHECK_MESSAGE(error.starts_with("a.su2:" + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
