// SPDX-License-Identifier: MIT
// Keyword files of LS-DYNA: degenerate solids, parts, sets, what stays word for word and what it pins.
#include "kernel/formats/lsdyna.h"

#include <algorithm>
#include <array>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/formats/deck_remarks.h"
#include "kernel/formats/lsdyna_fields.h"
#include "kernel/formats/nastran_card.h"
#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::string deck_text() {
  return "$ made by hand\n"
         "*KEYWORD\n"
         "*TITLE\n"
         "11 tets\n"
         "*PART\n"
         "left part\n"
         "         3         1         1\n"
         "right part\n"
         "         5         1         1\n"
         "*MAT_ELASTIC\n"
         "         1  7.85E-9    210000       0.3\n"
         "*NODE\n"
         "$#   nid               x               y               z      tc      rc\n"
         "      11             0.0             0.0             0.0       0       0\n"
         "      12      1.00000000             0.0             0.0\n"
         "      13             0.0-1.234567890E-01             0.0\n"
         "      14             0.0             0.0         1.5D-01       7       0\n"
         "      20             1.0             1.0             1.0\n"
         "*BOUNDARY_SPC_NODE\n"
         "        12         0         1         1         1\n"
         "*ELEMENT_SOLID\n"
         "       1       3      11      12      13      14      14      14      14      14\n"
         "       2       5\n"
         "      12      13      14      20       0       0       0       0       0       0\n"
         "*SET_SOLID_TITLE\n"
         "both of them\n"
         "         9\n"
         "         1         2\n"
         "*SET_NODE_LIST\n"
         "         4\n"
         "        13        20\n"
         "*SET_SEGMENT_TITLE\n"
         "wall\n"
         "         8\n"
         "        11        12        13        13\n"
         "*END\n";
}

MeshData read_deck(const TempFolder& folder, std::string_view content) {
  write_text(folder / "a.k", content);
  return read_mesh(folder / "a.k");
}

std::string edited(std::string text, std::string_view what, std::string_view by) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("a deck of LS-DYNA gives nodes, degenerate solids, parts and sets") {
  const TempFolder folder;
  const MeshData mesh = read_deck(folder, deck_text());
  CHECK(mesh.points[2] == Point(0, -0.123456789, 0));
  CHECK(mesh.points[3] == Point(0, 0, 0.15));
  CHECK(mesh.point_numbers == std::vector<std::int64_t>{11, 12, 13, 14, 20});
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 3}, {{1, 2, 3, 4}, 5}});
  CHECK(mesh.tet_numbers == std::vector<std::int64_t>{1, 2});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, 8}});
  std::vector<std::string> names;
  for (const Group& group : mesh.groups) names.push_back(group.name);
  CHECK(names == std::vector<std::string>{"left part", "right part", "both of them", "", "wall"});
  CHECK(mesh.notes.empty());
}

TEST_CASE(
    "nodes that other keywords of LS-DYNA name are required, titles and materials name none") {
  const TempFolder folder;
  const MeshData mesh = read_deck(folder, deck_text());
  // 14 has a constraint, 12 is held by a boundary; 13 and 20 are in a set of nodes.
  CHECK(mesh.required_vertices == std::vector<std::uint32_t>{1, 2, 3, 4});
  const std::vector<std::string> remarks = deck_remarks(mesh);
  REQUIRE(remarks.size() == 3);
  CHECK(remarks[0].ends_with("a.k:17: *NODE with constraints keeps 1 point where it is"));
  CHECK(remarks[1].ends_with("a.k:19: *BOUNDARY_SPC_NODE keeps 1 point where it is"));
  const std::string bare = edited(edited(deck_text(), "       7       0", ""), "*BOUNDARY_SPC_NODE",
                                  "*CONTROL_SOMETHING");
  CHECK(read_deck(folder, bare.substr(0, bare.find("*SET_NODE"))).required_vertices.empty());
}

TEST_CASE("a deck of LS-DYNA comes back, all but its mesh word for word") {
  const TempFolder folder;
  const MeshData mesh = read_deck(folder, deck_text());
  CHECK(not_written(folder / "b.k", mesh).empty());
  write_mesh(folder / "b.k", mesh);
  const std::string written = test::read_text(folder / "b.k");
  const MeshData again = read_mesh(folder / "b.k");
  CHECK(same_mesh(again, mesh));
  CHECK(again.groups == mesh.groups);
  CHECK(again.tet_numbers == mesh.tet_numbers);
  for (const std::string_view kept :
       {"$ made by hand\n*KEYWORD\n*TITLE\n11 tets\n", "*MAT_ELASTIC\n         1  7.85E-9",
        "1.5D-01       7       0\n", "*BOUNDARY_SPC_NODE\n        12", "$#   nid ",
        "*SET_SOLID_TITLE\nboth of them\n         9\n         1         2\n", "*END\n",
        "*SET_SEGMENT_TITLE\nwall\n         8\n        11        12        13        13\n"}) {
    CHECK_MESSAGE(written.find(kept) != std::string::npos, kept);
  }
  write_mesh(folder / "c.k", again);
  CHECK(written == test::read_text(folder / "c.k"));
}

TEST_CASE("solids of LS-DYNA with nodes twice are prisms and pyramids, and come back as such") {
  const TempFolder folder;
  std::string text = "*KEYWORD\n*NODE\n";
  for (int i = 0; i < 8; ++i) {
    text += std::to_string(i + 1) + "," + std::to_string(i % 4 == 1 || i % 4 == 2) + "," +
            std::to_string(i % 4 > 1) + "," + std::to_string(i / 4) + "\n";
  }
  text +=
      "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n2,1,1,2,3,4,5,5,5,5\n3,1,1,2,3,4,5,5,6,6\n4,1,1,2,3,"
      "5\n*END\n";
  const MeshData mesh = read_deck(folder, text);
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 4}, 1}});
  REQUIRE(mesh.other_elements.size() == 3);
  CHECK(mesh.other_elements[0].vtk_type == 12);
  CHECK(mesh.other_elements[1].vertices == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
  CHECK(mesh.other_elements[2].vertices == std::vector<std::uint32_t>{0, 4, 1, 3, 5, 2});
  write_mesh(folder / "b.k", mesh);
  CHECK(read_mesh(folder / "b.k").other_elements == mesh.other_elements);
}

TEST_CASE("ten nodes of a solid of LS-DYNA are read from two lines, or from one that goes on") {
  const TempFolder folder;
  std::string nodes = "*KEYWORD\n*NODE\n";
  for (int i = 1; i <= 10; ++i) nodes += std::to_string(i) + ",0," + std::to_string(i) + ",1.5\n";
  const MeshData two = read_deck(folder, nodes + "*ELEMENT_SOLID\n1,1\n1,2,3,4,5,6,7,8,9,10\n");
  const MeshData one = read_deck(folder, nodes + "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8,9,\n10\n");
  CHECK(two.mid_nodes.size() == 6);
  CHECK(one.mid_nodes == two.mid_nodes);
  write_mesh(folder / "b.key", two);
  CHECK(read_mesh(folder / "b.key").mid_nodes == two.mid_nodes);
}

TEST_CASE("a mesh of another format becomes a deck of LS-DYNA with parts, segments and sets") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  for (Point& point : mesh.points) point = {1, 2, 3};
  mesh.points[1] = {1.0 / 3, 0.5, -1e-7};
  mesh.required_vertices.clear();
  mesh.edges.clear();
  mesh.point_labels.clear();
  mesh.tets[0].label = 4;
  mesh.tets[1].label = 6;
  mesh.triangles = {{{0, 2, 1}, 12}, {{3, 0, 1}, 7}};
  mesh.groups = {{3, 4, "body", {}, {}}, {2, 12, "wall", {}, {}}, {0, 1, "nodes", {}, {0, 3}}};
  CHECK(not_written(folder / "a.k", mesh) ==
        std::vector<std::string>{
            "1 coordinates are rounded to 16 characters, which is what LS-DYNA reads"});
  write_mesh(folder / "a.k", mesh);
  const MeshData again = read_mesh(folder / "a.k");
  CHECK(again.tets == mesh.tets);
  CHECK(again.triangles[0].label == 7);
  CHECK(again.triangles[1].label == 12);
  CHECK(std::abs(again.points[1][0] - 1.0 / 3) < 1e-14);
  CHECK(again.points[1][2] == -1e-7);
  std::vector<std::string> names;
  for (const Group& group : again.groups) names.push_back(group.name);
  CHECK(names == std::vector<std::string>{"body", "nodes", "", "wall"});
}

TEST_CASE("segments of LS-DYNA pin no node unless they say more than a triangle") {
  const TempFolder folder;
  const std::string text =
      edited(edited(deck_text(), "       7       0", ""), "        13        20", "        20");
  const std::string wall = "        11        12        13        13\n";
  const auto required = [&](std::string_view what, std::string_view by) {
    return read_deck(folder, edited(text, what, by)).required_vertices;
  };
  using Points = std::vector<std::uint32_t>;
  CHECK(read_deck(folder, text).required_vertices == Points{1, 4});
  CHECK(required(wall, "$ one\n" + wall) == Points{1, 4});
  CHECK(required(wall, "        13        11        12\n") == Points{1, 4});
  CHECK(required(wall, "        11        12        13        13        0.       0.5\n") ==
        Points{0, 1, 2, 4});
  CHECK(required(wall, wall + wall) == Points{0, 1, 2, 4});
  // The other side of a face that another set has.
  CHECK(required("*END", "*SET_SEGMENT\n         9\n        11        13        12\n*END") ==
        Points{0, 1, 2, 4});
  const MeshData mesh = read_deck(folder, edited(text, wall, "$ one\n" + wall));
  write_mesh(folder / "b.k", mesh);
  CHECK(test::read_text(folder / "b.k").find("wall\n         8\n$ one\n" + wall) !=
        std::string::npos);
}

TEST_CASE("segments of LS-DYNA whose nodes are in another file stay in the deck with a note") {
  const TempFolder folder;
  const MeshData mesh =
      read_deck(folder, edited(deck_text(), "12        13        13", "99        13        13"));
  CHECK(mesh.triangles.empty());
  REQUIRE(mesh.notes.size() == 1);
  CHECK(mesh.notes[0].starts_with("1 lines of *SET_SEGMENT_TITLE name nodes that are not there"));
  write_mesh(folder / "b.k", mesh);
  CHECK(test::read_text(folder / "b.k").find("99        13") != std::string::npos);
}

TEST_CASE(
    "what a deck of LS-DYNA includes is read; files with something of the mesh are taken in") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "sub");
  const std::string all = deck_text();
  const std::size_t nodes = all.find("*NODE");
  const std::size_t boundary = all.find("*BOUNDARY");
  const std::size_t solids = all.find("*ELEMENT_SOLID");
  write_text(folder / "sub" / "mesh.k", "$ the mesh\n*KEYWORD\n" +
                                            all.substr(nodes, boundary - nodes) +
                                            "*INCLUDE\nsub/solids.k\n*END\n*NODE\n99,0,0,0\n");
  write_text(folder / "sub" / "solids.k", all.substr(solids));
  write_text(folder / "held.k", "$ held\n" + all.substr(boundary, solids - boundary));
  write_text(folder / "deck.k", "*KEYWORD\n*INCLUDE\n$ two files\nsub\\me +\n  sh.k\nheld.k\n" +
                                    all.substr(all.find("*PART"), nodes - all.find("*PART")) +
                                    "*END\n");
  const MeshData mesh = read_mesh(folder / "deck.k");
  const MeshData whole = read_deck(folder, all);
  CHECK(mesh.notes.empty());
  CHECK(mesh.points == whole.points);
  CHECK(mesh.tets == whole.tets);
  CHECK(mesh.groups == whole.groups);
  CHECK(mesh.required_vertices == whole.required_vertices);
  const std::vector<std::string> remarks = deck_remarks(mesh);
  REQUIRE(remarks.size() == 3);
  CHECK(remarks[0].ends_with("mesh.k:8: *NODE with constraints keeps 1 point where it is"));
  CHECK(remarks[2].ends_with("held.k:2: *BOUNDARY_SPC_NODE keeps 1 point where it is"));
  CHECK(source_files(folder / "deck.k").size() == 4);
  CHECK(not_written(folder / "b.k", mesh).empty());
  const auto elsewhere = not_written(folder / "sub" / "b.k", mesh);
  REQUIRE(elsewhere.size() == 1);
  CHECK(elsewhere[0].starts_with("the files of *INCLUDE stay in "));
  write_mesh(folder / "b.k", mesh);
  const std::string written = test::read_text(folder / "b.k");
  CHECK(written.starts_with("*KEYWORD\n*INCLUDE\n$ two files\nheld.k\n$ the mesh\n*NODE\n"));
  CHECK(written.find("*BOUNDARY") == std::string::npos);
  CHECK(written.find("*INCLUDE", 12) == std::string::npos);
  CHECK(written.find("*END") == written.size() - 5);
  const MeshData again = read_mesh(folder / "b.k");
  CHECK(again.tets == mesh.tets);
  CHECK(again.groups == mesh.groups);
  CHECK(again.required_vertices == mesh.required_vertices);
  CHECK(locate_tet(folder / "deck.k", 1).ends_with("sub/solids.k:3"));
}

TEST_CASE("names of files of LS-DYNA are looked for in the folders of *INCLUDE_PATH, too") {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "parts" / "inner");
  write_text(folder / "parts" / "inner" / "mesh.k", deck_text());
  write_text(folder / "a.k",
             "*KEYWORD\n*INCLUDE\nmesh.k\n*INCLUDE_PATH_RELATIVE\nnone\nparts\\inner\n*END\n");
  const MeshData mesh = read_mesh(folder / "a.k");
  CHECK(mesh.tets.size() == 2);
  write_mesh(folder / "b.k", mesh);
  const std::string written = test::read_text(folder / "b.k");
  CHECK(written.find("*INCLUDE\n") == std::string::npos);
  CHECK(written.find("*INCLUDE_PATH_RELATIVE\nnone\nparts\\inner\n") != std::string::npos);
}

TEST_CASE("a file that a deck of LS-DYNA includes and that cannot be read stays, with a note") {
  const TempFolder folder;
  const MeshData mesh =
      read_deck(folder, edited(deck_text(), "*TITLE", "*INCLUDE\ngone.k\n*TITLE"));
  REQUIRE(mesh.notes.size() == 1);
  CHECK(mesh.notes[0].starts_with("what *INCLUDE names is not read, so what it says of nodes is "));
  CHECK(mesh.notes[0].find("gone.k") != std::string::npos);
  write_mesh(folder / "b.k", mesh);
  CHECK(test::read_text(folder / "b.k").find("*INCLUDE\ngone.k\n*TITLE\n") != std::string::npos);
}

TEST_CASE(
    "a file of LS-DYNA with wider fields is read where it stays, and refused where it cannot") {
  const TempFolder folder;
  write_text(folder / "held.k",
             "*KEYWORD LONG=Y\n*BOUNDARY_SPC_NODE\n"
             "                  12                   0\n");
  const std::string held = edited(deck_text(), "*BOUNDARY_SPC_NODE\n        12",
                                  "*INCLUDE\nheld.k\n*CONTROL_SOMETHING\n        12");
  CHECK(read_deck(folder, held).required_vertices == std::vector<std::uint32_t>{1, 2, 3, 4});
  write_text(folder / "held.k", "*KEYWORD LONG=Y\n*NODE\n");
  CHECK(error_of_reading(folder / "a.k").starts_with("a.k:20: the file has other options"));
}

TEST_CASE("of the numbers of a keyword of LS-DYNA only those that are nodes pin nodes") {
  struct Row {
    std::string keyword, lines;
    std::vector<std::uint32_t> pinned;  // nodes of the numbers 11 to 14 and 20
  };
  // Each has a number that is a node, too: of a curve, a box, a part, a direction.
  const auto rows = std::to_array<Row>({
      {"BOUNDARY_SPC_NODE", "11,12,13,14\n20,0,11\n", {0, 4}},
      {"BOUNDARY_SPC_NODE_ID", "12,the foot\n11,0,1,1,1\n", {0}},
      {"BOUNDARY_SPC_NODE_BIRTH_DEATH", "11,0,1\n12,13\n14,0,1\n12,13\n", {0, 3}},
      {"BOUNDARY_PRESCRIBED_MOTION_NODE", "11,1,2,14,1.0,13\n12,1,2,14\n", {0, 1}},
      {"BOUNDARY_PRESCRIBED_MOTION_NODE", "11,9,2,14\n12,12,0,13,14\n20,1,2,12\n", {0, 2, 3, 4}},
      {"BOUNDARY_PRESCRIBED_MOTION_NODE", "11,1,4,14\n12,12,0,13,14\n", {0, 2, 3}},
      {"LOAD_NODE_POINT", "11,12,13,1.0,20\n11,4,13,1.0,20,12,14,20\n", {0, 1, 3, 4}},
      {"LOAD_NODE_SET", "11,4,13,1.0,20,12,14,20\n", {1, 3, 4}},
      {"LOAD_SEGMENT", "11,1.0,0.0,12,13,14,14\n", {1, 2, 3}},
      {"LOAD_SEGMENT", "13,1.0,0.0,12,12,12,12,11\n14,14,14\n13,1.0,0.0,12,12,12,12\n", {0, 1, 3}},
      {"DEFINE_BOX", "11,12,13,14,20,12,13\n", {}},
      {"DEFINE_COORDINATE_NODES", "11,12,13,14\n", {1, 2, 3}},
      {"DEFINE_VECTOR", "11,12,13,14,20,12,13\n", {}},
      {"RIGIDWALL_PLANAR_MOVING", "11,12,13\n14,20,12,13\n", {}},
      {"CONSTRAINED_NODAL_RIGID_BODY", "11,12,13\n11,12,13,14\n", {3}},
      {"CONSTRAINED_NODAL_RIGID_BODY_INERTIA", "11,12,13\n", {0, 1, 2}},  // not known
      {"CONSTRAINED_EXTRA_NODES_NODE", "11,12\n", {1}},
      {"CONSTRAINED_JOINT_REVOLUTE_ID", "20,hinge\n11,12,13,14,0,0,20\n", {0, 1, 2, 3}},
      {"DATABASE_HISTORY_NODE", "11,12\n", {0, 1}},
      {"DATABASE_HISTORY_NODE_ID", "11,20\n", {0}},
      {"DATABASE_NODAL_FORCE_GROUP", "11,12\n", {}},
      {"ELEMENT_MASS", "11,12,1.0\n", {1}},
      {"ELEMENT_BEAM", "11,12,13,14\n", {2, 3}},
      {"SET_NODE_GENERAL", "7\nPART,11,12\nbox,13\nNode,14,20\n", {3, 4}},
      {"SET_SEGMENT_GENERAL", "7\nPART,11,12\nSEG,12,13,14,14,20\n", {1, 2, 3}},
      {"SET_NODE_ADD", "7\n11,12\n", {}},
      {"SET_NODE_COLUMN", "7\n11,12\n", {0}},
      {"SET_SEGMENT", "7\n11,12,13,13,14,20\n", {0, 1, 2}},
      {"A_KEYWORD_OF_TOMORROW", "11,12\n", {0, 1}},
  });
  const TempFolder folder;
  std::string text = edited(deck_text(), "       7       0", "");
  text = edited(text, "*BOUNDARY_SPC_NODE", "*CONTROL_SOMETHING");
  text = text.substr(0, text.find("*SET_SOLID"));
  REQUIRE(read_deck(folder, text).required_vertices.empty());
  for (const Row& row : rows) {
    CAPTURE(row.keyword);
    CAPTURE(row.lines);
    CHECK(read_deck(folder, text + "*" + row.keyword + "\n" + row.lines).required_vertices ==
          row.pinned);
  }
}

TEST_CASE("a set of nodes of LS-DYNA that fills a volume pins none, and is written anew") {
  const TempFolder folder;
  std::string text = edited(deck_text(), "       7       0", "");
  text = edited(text, "*BOUNDARY_SPC_NODE", "*CONTROL_SOMETHING");
  text = edited(text, "        13        20\n", "        11        14\n");
  text = edited(text, "*SET_NODE_LIST\n", "*SET_NODE_LIST_GENERATE\n");
  MeshData mesh = read_deck(folder, text.substr(0, text.find("*SET_SEGMENT")));
  CHECK(mesh.required_vertices.empty());
  REQUIRE(mesh.groups.back().dimension == 0);
  mesh.groups.back().members.push_back(4);
  write_mesh(folder / "b.k", mesh);
  CHECK(
      test::read_text(folder / "b.k")
          .ends_with(
              "*SET_NODE_LIST\n         4\n        11        12        13        14        20\n"));
}

TEST_CASE("wide fields of LS-DYNA are read and written") {
  const TempFolder folder;
  const std::string text =
      "*KEYWORD I10=Y\n*NODE\n"
      "         1             0.0             0.0             0.0\n"
      "         2             1.0             0.0             0.0\n"
      "         3             0.0             1.0             0.0\n"
      "1234567890             0.0             0.0             1.0\n"
      "*ELEMENT_SOLID\n"
      "         7         1         1         2         31234567890123456789012345678901234567890"
      "1234567890\n*END\n";
  const MeshData mesh = read_deck(folder, text);
  CHECK(mesh.tets.size() == 1);
  write_mesh(folder / "b.k", mesh);
  CHECK(read_mesh(folder / "b.k").point_numbers == mesh.point_numbers);
}

TEST_CASE("long fields of a deck of LS-DYNA, or of one keyword, are read and written") {
  const auto wide = [](std::initializer_list<std::string_view> fields, std::size_t width) {
    std::string line;
    for (const std::string_view field : fields)
      line += std::string(width - field.size(), ' ') + std::string(field);
    return line + "\n";
  };
  const auto nodes = [&](const std::string& keyword, std::size_t first, std::size_t others) {
    std::string text = "*NODE" + keyword + "\n";
    for (const char* const node : {"1 0 0 0 0", "2 1 0 0 0", "3 0 1 0 7", "4 0 0 1 0"}) {
      std::string_view left = node;
      for (std::size_t k = 0; k < 5; ++k) {
        text += wide({left.substr(0, 1)}, k == 0 || k == 4 ? first : others);
        text.pop_back();
        left.remove_prefix(std::min<std::size_t>(2, left.size()));
      }
      text += "\n";
    }
    return text;
  };
  const auto sets = [&](const std::string& keyword, std::size_t width) {
    return "*SET_NODE_LIST" + keyword + "\n" + wide({"5"}, width) +
           wide({"1", "2", "3", "4"}, width);
  };
  const std::string solids = "*ELEMENT_SOLID\n1,1,1,2,3,4,4,4,4,4\n";
  const std::string end = "*END\n";
  const std::vector<std::string> decks = {
      "*KEYWORD LONG=Y\n" + nodes("", 20, 20) + solids + sets("", 20) + end,
      "*KEYWORD\n" + nodes(" +", 20, 20) + solids + sets("  +", 20) + end,
      "*KEYWORD\n" + nodes(" %", 10, 16) + solids + sets("", 10) + end,
      "*KEYWORD LONG=Y\n" + nodes(" -", 8, 16) + solids + sets(" -", 10) + end};
  for (const std::string& deck : decks) {
    CAPTURE(deck);
    const TempFolder folder;
    const MeshData mesh = read_deck(folder, deck);
    REQUIRE(mesh.tets.size() == 1);
    CHECK(mesh.points[2] == Point(0, 1, 0));
    CHECK(mesh.required_vertices == std::vector<std::uint32_t>{2});
    REQUIRE(mesh.groups.size() == 1);
    CHECK(mesh.groups[0].members.size() == 4);
    write_mesh(folder / "b.k", mesh);
    const MeshData again = read_mesh(folder / "b.k");
    CHECK(again.points == mesh.points);
    CHECK(again.groups == mesh.groups);
    CHECK(again.required_vertices == mesh.required_vertices);
  }
}

TEST_CASE("options of a second *KEYWORD of LS-DYNA hold for the nodes before it") {
  const TempFolder folder;
  const std::string text =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT_SOLID\n1,1,1,2,3,4\n"
      "*KEYWORD LONG=Y\n*SET_NODE\n5\n1,2,3,4\n*END\n";
  const MeshData mesh = read_deck(folder, text);
  write_mesh(folder / "b.k", mesh);
  const MeshData again = read_mesh(folder / "b.k");
  CHECK(same_mesh(again, mesh));
  CHECK(again.groups == mesh.groups);
}

TEST_CASE("ranges of sets of LS-DYNA are read in small letters, and with steps stay as they are") {
  const TempFolder folder;
  const std::string mesh_text =
      "*KEYWORD\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,1,1\n"
      "*ELEMENT_SOLID\n1,1,1,2,3,4\n2,1,2,3,4,5\n";
  const MeshData small = read_deck(folder, mesh_text + "* set_node_list_generate\n5\n1,4\n*END\n");
  REQUIRE(small.groups.size() == 1);
  write_mesh(folder / "b.k", small);
  CHECK(read_text(folder / "b.k").find("* set_node_list\n5\n") != std::string::npos);
  CHECK(read_mesh(folder / "b.k").groups == small.groups);
  const std::string steps = "*SET_SOLID_GENERATE_INCREMENT\n6\n1,2,1\n";
  const MeshData stepped =
      read_deck(folder, mesh_text + steps + "*SET_NODE_LIST_GENERATE_INCREMENT\n7\n2,4,2\n*END\n");
  CHECK(stepped.groups.empty());
  CHECK(stepped.required_vertices == std::vector<std::uint32_t>{1, 2, 3});
  CHECK(stepped.notes.size() == 1);
  write_mesh(folder / "b.k", stepped);
  CHECK(read_text(folder / "b.k").find(steps) != std::string::npos);
}

TEST_CASE(
    "comments of a deck of LS-DYNA stay before the keyword or in the list that they stand at") {
  const TempFolder folder;
  const std::string text =
      "*KEYWORD\n*NODE\n1,0,0,0\n$ second\n2,1,0,0\n3,0,1,0\n$ ---- solids\n*ELEMENT_SOLID\n"
      "1,1,1,2,3,4\n$ ---- more nodes\n*NODE\n$ fourth\n4,0,0,1\n$ ---- sets\n*SET_NODE_LIST\n5\n"
      "1,2\n$ the others\n3,4\n$ ---- end\n*END\n";
  write_mesh(folder / "b.k", read_deck(folder, text));
  const std::string written = read_text(folder / "b.k");
  for (const std::string_view kept :
       {"*NODE\n$ second\n$ fourth\n  ", "$ ---- solids\n*ELEMENT_SOLID\n  ",
        "$ ---- more nodes\n$ ---- sets\n*SET_NODE_LIST\n5\n$ the others\n  ",
        "$ ---- end\n*END\n"}) {
    CHECK_MESSAGE(written.find(kept) != std::string::npos, kept);
  }
  write_mesh(folder / "c.k", read_mesh(folder / "b.k"));
  CHECK(read_text(folder / "c.k") == written);
}

TEST_CASE("a deck of LS-DYNA without solids of its own is read again") {
  const TempFolder folder;
  write_mesh(folder / "b.k", read_deck(folder,
                                       "*KEYWORD\n*NODE\n1,0,0,0\n*ELEMENT_SOLID\n"
                                       "*ELEMENT_SOLID_ORTHO\n1,1\n*END\n"));
  CHECK(read_mesh(folder / "b.k").points.size() == 1);
}

TEST_CASE("numbers of LS-DYNA that are wider than their fields are written between commas") {
  const TempFolder folder;
  const std::string text =
      "*KEYWORD\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n12345678901,0,0,1\n"
      "*ELEMENT_SOLID\n2147483648,1,1,2,3,12345678901,12345678901,12345678901,12345678901,"
      "12345678901\n*SET_NODE\n5\n1,12345678901\n*END\n";
  const MeshData mesh = read_deck(folder, text);
  REQUIRE(mesh.tets.size() == 1);
  write_mesh(folder / "b.k", mesh);
  const MeshData again = read_mesh(folder / "b.k");
  CHECK(same_mesh(again, mesh));
  CHECK(again.point_numbers == mesh.point_numbers);
  CHECK(again.tet_numbers == mesh.tet_numbers);
  CHECK(again.groups == mesh.groups);
}

TEST_CASE("a number of LS-DYNA that is rounded to its field is not rounded again") {
  for (const double value :
       {-9223372036854775.0, 1.2345678901234567e-5, -1.2345678901234567e-5, 1.7976931348623157e308,
        -123456.78901234567, 1.0 / 3, 1e22 / 7, -4.9406564584124654e-324}) {
    const std::string text = formats::lsdyna_real(value, 16);
    CAPTURE(text);
    CHECK(text.size() <= 16);
    double again = 0;
    REQUIRE(formats::nastran_real(text, again));
    CHECK(again == doctest::Approx(value).epsilon(1e-8));
    CHECK(formats::lsdyna_real(again, 16) == text);
  }
}

TEST_CASE("a node of LS-DYNA that is held comes back where its line is no line of fixed fields") {
  const TempFolder folder;
  const std::string text = edited(
      deck_text(), "      14             0.0             0.0         1.5D-01       7       0\n",
      "      14 0.0  0.0 0.15 7 0\n     120 9. 9. 9. 7 0\n");
  const MeshData mesh = read_deck(folder, text);
  REQUIRE(mesh.points.size() == 6);
  write_mesh(folder / "b.k", mesh);
  const MeshData again = read_mesh(folder / "b.k");
  CHECK(again.points == mesh.points);
  CHECK(again.point_numbers == mesh.point_numbers);
}

TEST_CASE("a tet of a deck of LS-DYNA is located by its line") {
  const TempFolder folder;
  write_text(folder / "a.k", deck_text());
  CHECK(locate_tet(folder / "a.k", 1).ends_with("a.k:23"));
}

TEST_CASE("a segment of LS-DYNA with a node twice is told with its own line, not that of a tet") {
  const TempFolder folder;
  const std::string segment = "        11        12        12        12\n";
  const std::string text = edited(deck_text(), "*END", segment + "*END");
  const auto line =
      std::count(text.begin(), text.begin() + static_cast<long>(text.find(segment)), '\n') + 1;
  const MeshData mesh = read_deck(folder, text);
  REQUIRE(mesh.notes.size() == 1);
  CHECK(mesh.notes[0].starts_with((folder / fmt::format("a.k:{}: triangle 2", line)).string()));
}

TEST_CASE("a deck of LS-DYNA with a byte changed or cut away never crashes") {
  const TempFolder folder;
  write_text(folder / "a.k", deck_text());
  change_each_byte(folder / "a.k", folder / "a.k");
  cut_at_each_byte(folder / "a.k");
}

TEST_CASE("a bad deck of LS-DYNA is refused with line and reason") {
  const std::string good = deck_text();
  const std::vector<BadFile> files = {
      {"empty", "", "1: ", "the file is empty"},
      {"other", "solid x\n", "1: ", "the file has no keywords: expected *KEYWORD and *NODE"},
      {"no nodes", "*KEYWORD\n*END\n", "", "the file has no nodes: expected *NODE"},
      {"text", edited(good, "1.00000000", "1.0000000x"), "15: ", "is not a finite number"},
      {"infinite", edited(good, "1.5D-01", "1.D+999"), "17: ", "is not a finite number"},
      {"twice", edited(good, "      12 ", "      11 "),
       "15: ", "the number '11' of a node appears for the second time"},
      {"node", edited(good, "      20       0", "      21       0"),
       "23: ", "'21' is not the number of a node: expected one of *NODE"},
      {"parameter", edited(good, "      11      12", "      &n      12"),
       "22: ", "'&n' is not an integer"},
      {"few", edited(good, "      12      13      14      20", "      12      13"),
       "23: ", "an element has 2 nodes: expected 4, 6, 8 or 10"},
      {"nine",
       edited(good, "       0       0       0       0       0       0\n",
              "      20      20      20      20      20       0\n"),
       "23: ", "the element is none of 4, 5, 6, 8 or 10 nodes"},
      {"solid twice", edited(good, "       2       5\n", "       1       5\n"),
       "23: ", "the number '1' of a solid appears for the second time"},
      {"include", "*KEYWORD\n*INCLUDE\nmesh.k\n*END\n",
       "3: ", "there are no nodes, and of the files of *INCLUDE not all are read: "},
      {"include of options", "*KEYWORD\n*INCLUDE_TRANSFORM\nmesh.k\n*END\n",
       "3: ", "there are no nodes, and *INCLUDE_TRANSFORM is not followed"},
      {"itself", edited(good, "*END", "*INCLUDE\n./a.k\n*END"),
       "37: ", "'./a.k' includes itself: expected another file"},
      {"other solids", edited(good, "*ELEMENT_SOLID\n", "*ELEMENT_SOLID_ORTHO\n"),
       "21: ", "solids of *ELEMENT_SOLID_ORTHO cannot be read"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.k", bad.content);
    const std::string error = error_of_reading(folder / "a.k");
    CHECK_MESSAGE(error.starts_with("a.k:" + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
