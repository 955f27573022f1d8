// SPDX-License-Identifier: MIT
// Nastran's bulk data: three forms of fields, numbers that stay, and the rest of the deck.
#include "kernel/formats/nastran.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <doctest/doctest.h>

#include "kernel/formats/deck_remarks.h"
#include "kernel/formats/nastran_card.h"
#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Small, large and free fields; points behind elements; loads, and a point in other coordinates.
std::string nastran_text() {
  return "SOL 101\n"
         "CEND\n"
         "SPC = 1\n"
         "begin bulk\n"
         "$ a comment\n"
         "PARAM,POST,-1\n"
         "CTETRA  7       3       10      20      30      40\n"
         "CTETRA  12      3       10      20      30      40      50      60      +A\n"
         "+A      70      80      90      100\n"
         "CTRIA3* 9               4               10              20\n"
         "*       30\n"
         "CTRIA3  15      4       10      20      40      45.\n"
         "CPENTA,17,8,10,20,30,40,50,60\n"
         "CQUAD4,16,4,10,20,30,40\n"
         "CTETRA,5,,20,30,40,110\n"
         "PSOLID,3,1\n"
         "MAT1,1,2.+11,,.3\n"
         "GRID    10              0.      0.      0.\n"
         "GRID*   20                              1.0D+0          -1.5-3\n"
         "*       +.25\n"
         "GRID,30,0,,1.\n"
         "GRID,40,,0,0,1\n"
         "GRID,50,,1,0,0,2\n"
         "GRID,60,,1,.5,0\nGRID,70,,2,0,0\nGRID,80,,3,0,0\nGRID,90,,4,0,0\nGRID,100,,5,0,0\n"
         "GRID,110,,6,0,0\n"
         "GRID,7000,,7,0,0\n"
         "SPC1,1,123,60,THRU,85\n"
         "FORCE   2       90      0       1.0     0.0     0.0     1.0\n"
         "ENDDATA\n"
         "$ behind\n";
}

const std::string kLinear =
    "BEGIN BULK\nGRID,20\nGRID,30,,1.\nGRID,40,,,1.\nGRID,50,,,,1.\nCTETRA,7,1,20,30,40,50\n"
    "ENDDATA\n";

/// Without the remarks, which have lines of the file.
std::vector<std::string> nastran_deck_of(const MeshData& mesh) {
  std::vector<std::string> deck = mesh.deck;
  deck.resize(std::min<std::size_t>(deck.size(), formats::nastran_pieces));
  return deck;
}

bool same_nastran_extras(const MeshData& a, const MeshData& b) {
  return a.other_elements == b.other_elements && nastran_deck_of(a) == nastran_deck_of(b) &&
         a.variant == b.variant && a.point_numbers == b.point_numbers &&
         a.tet_numbers == b.tet_numbers && a.triangle_numbers == b.triangle_numbers;
}

}  // namespace

TEST_CASE("a deck of Nastran gives points and elements with their numbers, whatever the fields") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.bdf", nastran_text());
  CHECK(mesh.point_numbers ==
        std::vector<std::int64_t>{10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 7000});
  CHECK(mesh.points[1] == Point(1, -0.0015, 0.25));
  CHECK(mesh.points[2] == Point(0, 1, 0));
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 3}, {{1, 2, 3, 10}, 0}});
  CHECK(mesh.tet_numbers == std::vector<std::int64_t>{7, 5});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, 4}, {{0, 1, 3}, 4}});
  CHECK(mesh.triangle_numbers == std::vector<std::int64_t>{9, 15});
  REQUIRE(mesh.other_elements.size() == 3);
  CHECK(mesh.other_elements[0].vtk_type == 24);
  CHECK(mesh.other_elements[0].vertices ==
        std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(mesh.other_elements[2].numbers == std::vector<std::int64_t>{16});
  CHECK(mesh.other_elements[1].vtk_type == 13);
  CHECK(notes_but_of_orders(mesh).empty());
  CHECK(mesh.notes.size() == 1);
}

TEST_CASE("what is no mesh in a deck of Nastran stays word for word, and its points are required") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.bdf", nastran_text());
  const std::vector<std::string> deck = {
      "SOL 101\nCEND\nSPC = 1\nbegin bulk\n",
      "$ a comment\nPARAM,POST,-1\nPSOLID,3,1\nMAT1,1,2.+11,,.3\nSPC1,1,123,60,THRU,85\n"
      "FORCE   2       90      0       1.0     0.0     0.0     1.0\n",
      "ENDDATA\n$ behind\n",
      "GRID,50,,1,0,0,2\n",
      "CTRIA3  15      4       10      20      40      45.\n",
      "",
      ""};
  CHECK(nastran_deck_of(mesh) == deck);
  CHECK(mesh.taken_point_numbers.back() == NumberRange(7000, 7000));
  CHECK(mesh.taken_element_numbers.back().second == 17);
  // 60 to 80 for SPC1, 90 for FORCE. The coordinates of 50 are no constraint.
  CHECK(mesh.required_vertices == std::vector<std::uint32_t>{5, 6, 7, 8});
  const std::string file = (folder / "a.bdf").string();
  CHECK(deck_remarks(mesh) ==
        std::vector<std::string>{file + ":31: SPC1 keeps 3 points where they are",
                                 file + ":32: FORCE keeps 1 point where it is"});
}

TEST_CASE("a deck of Nastran survives writing, and the second time with the same bytes") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.bdf", nastran_text());
  CHECK(not_written(folder / "b.nas", mesh).empty());
  write_mesh(folder / "b.nas", mesh);
  const MeshData again = read_mesh(folder / "b.nas");
  CHECK(same_mesh(again, mesh));
  CHECK(again.point_numbers == mesh.point_numbers);
  CHECK(again.other_elements == mesh.other_elements);
  CHECK(same_nastran_extras(again, mesh));
  write_mesh(folder / "c.nas", again);
  CHECK(test::read_text(folder / "b.nas") == test::read_text(folder / "c.nas"));
}

TEST_CASE("a card of Nastran keeps the points that it names, and no other number") {
  const std::vector<std::pair<std::string, std::vector<std::uint32_t>>> cards = {
      {"GRAV,10,,9.8,20.", {}},
      {"LOAD,10,1.,1.,20,1.,30", {}},
      {"PLOAD4,10,20,1.", {}},
      {"PLOAD4,10,20,1.,,,,30,40", {2, 3}},
      {"PLOAD4,10,20,1.,,,,THRU,40", {}},
      {"MOMENT,10,20,30,1.,0.,0.,1.", {1}},
      {"SPC,10,20,30,0.,40,50,0.", {1, 3}},
      {"SPC1,10,20,30,THRU,60", {2, 3, 4, 5}},
      {"MPC,10,20,30,1.,40,50,-1.,,+\n+,,60,70,1.,80,90,1.", {1, 3, 5, 7}},
      {"RBE2,10,20,30,40,50", {1, 3, 4}},
      {"RBE3,10,,20,30,1.,40,50,60,+\n+,70,2.,80,90,UM,100,10", {1, 4, 5, 6, 8, 9}},
      {"CBAR,10,20,30,40,50", {2, 3, 4}},
      {"CBAR,10,20,30,40,0.,0.,1.", {2, 3}},
      {"CONM2,10,20,30,40.", {1}},
      {"CELAS1,10,20,30,40,50,60", {2, 4}},
      {"TEMP,10,20,30.,40,50.", {1, 3}},
      {"CORD1R,10,20,30,40", {1, 2, 3}},
      {"ASET,10,20,30,40", {0, 2}},
      {"ASET1,10,20,30", {1, 2}},
      {"DMIG,10,0,20,30", {}},
      {"DMIG,A,10,20,,30,40,1.", {0, 2}},
      {"SET3,10,ELEM,20,30", {}},
      {"SET3,10,GRID,20,30", {1, 2}},
      {"SET,10,ELEM,LIST,,,,,,+\n+,20,30", {}},
      {"SET,10,ELEM,20,30", {}},
      {"SET,10,GRID,LIST,,,,,,+\n+,20,THRU,40,60", {1, 2, 3, 5}},
      {"SET,10,grid,20,30", {1, 2}},
      {"SET,10,GRID,BBOX,,20,30", {}},
      {"SET,10,FREQ,LIST,,,,,,+\n+,20.,30", {}},
      {"SET,10,20,30", {0, 1, 2}},
      {"PARAM,GRDPNT,20", {1}},
      {"TSTEP,10,20,30.,40", {}},
      {"DESVAR,10,A,20.", {}},
      {"GRDSET,,,,,,,20", {}},
      {"UNHEARD,10,20", {0, 1}}};
  std::string base = nastran_text();
  for (const char* line : {"SPC1,1,123,60,THRU,85\n",
                           "FORCE   2       90      0       1.0     0.0     0.0     1.0\n"}) {
    base = replaced(base, line, "");
  }
  const TempFolder folder;
  for (const auto& each : cards) {
    CAPTURE(each.first);
    CHECK(read_as(folder, "a.bdf", replaced(base, "ENDDATA", each.first + "\nENDDATA"))
              .required_vertices == each.second);
  }
}

TEST_CASE("the last of a thousand fields of a card of Nastran keeps its point as the first does") {
  std::string card = "SPC1,1,123,10,10,10,10,10,10,+\n";
  for (int i = 0; i < 120; ++i) card += "+,10,10,10,10,10,10,10,10,+\n";
  const TempFolder folder;
  const MeshData mesh = read_as(
      folder, "a.bdf", replaced(nastran_text(), "SPC1,1,123,60,THRU,85\n", card + "+,20\n"));
  CHECK(mesh.required_vertices == std::vector<std::uint32_t>{0, 1, 8});
}

TEST_CASE("fields 7 to 9 of a GRID go where the point goes, and field 8 alone keeps it in place") {
  const TempFolder folder;
  const std::string base = replaced(nastran_text(), "SPC1,1,123,60,THRU,85\n", "");
  MeshData mesh =
      read_as(folder, "a.bdf", replaced(base, "GRID,60,,1,.5,0\n", "GRID,60,,1,.5,0,3,456,2\n"));
  CHECK(mesh.required_vertices == std::vector<std::uint32_t>{5, 8});
  CHECK(deck_remarks(mesh)[0] ==
        (folder / "a.bdf").string() +
            ":24: GRID with constraints in field 8 keeps 1 point where it is");
  mesh.points[4].x() = 1.5;
  write_mesh(folder / "b.bdf", mesh);
  const std::string written = test::read_text(folder / "b.bdf");
  CHECK(written.find("GRID*                 50                             1.5              0.\n"
                     "*                     0.               2\n") != std::string::npos);  // moved
  CHECK(written.find("GRID,60,,1,.5,0,3,456,2\n") != std::string::npos);  // as it was
  const MeshData again = read_mesh(folder / "b.bdf");
  CHECK(again.points == mesh.points);
  CHECK(again.required_vertices == mesh.required_vertices);
  const MeshData zero =
      read_as(folder, "a.bdf", replaced(base, "GRID,60,,1,.5,0\n", "GRID,60,,1,.5,0,0,0\n"));
  CHECK(zero.required_vertices == std::vector<std::uint32_t>{8});
}

TEST_CASE("middle nodes of Nastran's bricks and wedges come in another order than VTK's") {
  const TempFolder folder;
  MeshData mesh;
  for (int i = 0; i < 20; ++i) mesh.points.emplace_back(i, 0, 0);
  OtherElements brick{25, 20, {}, {2}, {}, {}, {}};
  OtherElements wedge{26, 15, {}, {2}, {}, {}, {}};
  for (std::uint32_t i = 0; i < 20; ++i) brick.vertices.push_back(i);
  for (std::uint32_t i = 0; i < 15; ++i) wedge.vertices.push_back(i);
  mesh.other_elements = {brick, wedge};
  write_mesh(folder / "a.bdf", mesh);
  const std::string text = test::read_text(folder / "a.bdf");
  // Between bottom and top: 17 to 20 of VTK's brick, 13 to 15 of its wedge.
  CHECK(text.find("CHEXA,1,2,1,2,3,4,5,6,+\n+,7,8,9,10,11,12,17,18,+\n+,19,20,13,14,15,16\n") !=
        std::string::npos);
  CHECK(text.find("CPENTA,2,2,1,2,3,4,5,6,+\n+,7,8,9,13,14,15,10,11,+\n+,12\n") !=
        std::string::npos);
  const MeshData again = read_mesh(folder / "a.bdf");
  CHECK(again.other_elements[0].vertices == brick.vertices);
  CHECK(again.other_elements[1].vertices == wedge.vertices);
}

TEST_CASE("new points and elements get numbers above all of a deck of Nastran") {
  const TempFolder folder;
  MeshData mesh = read_as(folder, "a.bdf",
                          replaced(nastran_text(), "PSOLID,3,1\n", "CBAR,900,1,10,20,0.,0.,1.\n"));
  mesh.points.emplace_back(1, 2, 3);
  mesh.point_numbers.push_back(0);
  mesh.tets.push_back({{1, 2, 3, 12}, 3});
  mesh.tet_numbers.push_back(0);
  write_mesh(folder / "b.bdf", mesh);
  const MeshData again = read_mesh(folder / "b.bdf");
  CHECK(again.point_numbers.back() == 7001);
  CHECK(again.tet_numbers.back() == 901);
}

TEST_CASE(
    "where a deck of Nastran has the greatest number there is, new ones are those that are free") {
  const TempFolder folder;
  struct Greatest {
    std::string number;
    std::int64_t tet;
  };
  // 1 and 2 stand in other cards.
  for (const Greatest& greatest : {Greatest{"9223372036854775807", 3}, Greatest{"2147483647", 3},
                                   Greatest{"99999999", 3}, Greatest{"99999997", 99999998}}) {
    CAPTURE(greatest.number);
    const std::string deck =
        replaced(replaced(nastran_text(), "CTRIA3  15      4       10      20      40      45.",
                          "CTRIA3,15,4,10,20,40\nCTRIA3," + greatest.number + ",4,10,20,40"),
                 "PSOLID,3,1\n", "CBAR,1,1,10,20,0.,0.,1.\n");
    MeshData mesh =
        read_as(folder, "a.bdf", replaced(deck, "GRID,7000,", "GRID,9223372036854775807,"));
    mesh.points.emplace_back(1, 2, 3);
    mesh.point_numbers.push_back(0);
    mesh.tets.push_back({{1, 2, 3, 12}, 3});
    mesh.tet_numbers.push_back(0);
    write_mesh(folder / "b.bdf", mesh);
    const MeshData again = read_mesh(folder / "b.bdf");
    CHECK(again.tet_numbers.back() == greatest.tet);
    CHECK(again.point_numbers.back() == 3);
    CHECK(again.tets == mesh.tets);
  }
}

TEST_CASE("labels below 1 become other properties of Nastran, and that is said") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  mesh.tets[0].label = 0;
  mesh.tets[1].label = 1;
  write_mesh(folder / "a.bdf", mesh);
  const MeshData again = read_mesh(folder / "a.bdf");
  CHECK(again.tets[0].label == 3);
  CHECK(again.tets[1].label == 1);
  CHECK(again.triangles[1].label == 2);
  CHECK(again.triangles[0].label == 12);
  CHECK(not_written(folder / "a.bdf", mesh)[1] ==
        "1 labels below 1 are not kept: .bdf has no place for them");
}

TEST_CASE("reals of Nastran may lack their letter") {
  double value = 0;
  for (const auto& [word, expected] :
       {std::pair("1.5-3", 1.5e-3), std::pair("-1.5+3", -1.5e3), std::pair("+.5", 0.5),
        std::pair("7.", 7.0), std::pair("1.D2", 100.0), std::pair("2e-3", 2e-3)}) {
    const char* const text = word;
    CAPTURE(text);
    CHECK(formats::nastran_real(text, value));
    CHECK(value == expected);
  }
  for (const char* text : {"", "a", "1.5-", "1.5-3-2", "--1", "nan", "inf", "1e999", "1 2", "+"}) {
    CAPTURE(text);
    CHECK(!formats::nastran_real(text, value));
  }
}

TEST_CASE("bulk data of Nastran without BEGIN BULK are read; without ENDDATA with a note") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.bdf", "$ made by hand\nGRID,1\nGRID,2,,1.\nENDDATA\n");
  CHECK(mesh.points.size() == 2);
  write_mesh(folder / "b.bdf", mesh);  // as other programs want it
  CHECK(test::read_text(folder / "b.bdf").starts_with("BEGIN BULK\nGRID*"));
  for (const char* begin : {"", "SOL 101\nCEND\n BEGIN BULK\n"}) {
    const MeshData open = read_as(folder, "a.bdf", std::string(begin) + "GRID,1\nGRID,2,,1.\n");
    CHECK(open.points.size() == 2);
    CHECK(notes_but_of_orders(open) ==
          std::vector<std::string>{"the bulk data have no ENDDATA: is the file complete?"});
  }
}

TEST_CASE("cards of Nastran that name elements are kept with a note") {
  const TempFolder folder;
  const MeshData mesh = read_as(
      folder, "a.bdf", replaced(nastran_text(), "FORCE ", "PLOAD4,1,7,1.\nPLOAD4,1,5,1.\nFORCE "));
  CHECK(notes_but_of_orders(mesh) ==
        std::vector<std::string>{"the card PLOAD4 names elements: where improving replaces them "
                                 "it must be made anew"});
}

TEST_CASE("sets of elements in the bulk data of OptiStruct are told once, with the first") {
  const TempFolder folder;
  const std::string sets =
      "SET,4,ELEM,LIST,,,,,,+\n+,7,5\nSET,6,GRID,LIST,,,,,,+\n+,20\nSET     5       ELEM    5\n";
  const MeshData mesh = read_as(folder, "a.bdf", replaced(kLinear, "ENDDATA", sets + "ENDDATA"));
  CHECK(notes_but_of_orders(mesh) ==
        std::vector<std::string>{"2 sets name elements, the first is SET 4: where improving "
                                 "replaces them it must be made anew"});
  write_mesh(folder / "b.bdf", mesh);
  CHECK(read_text(folder / "b.bdf").find(sets) != std::string::npos);
}

TEST_CASE("a note about a card of Nastran is one line, also of a card of two") {
  const TempFolder folder;
  const MeshData mesh =
      read_as(folder, "a.bdf", replaced(nastran_text(), "FORCE ", "INCLUDE,a,b\n*,c\nFORCE "));
  REQUIRE(notes_but_of_orders(mesh).size() == 1);
  CHECK(notes_but_of_orders(mesh)[0].find("INCLUDE,a,b\\n*,c' includes is not read") !=
        std::string::npos);
}

namespace {

constexpr const char* kGridCards =
    "GRID,1\nGRID,2,,1.\nGRID,3,,0.,1.\nGRID,4,,0.,0.,1.\nGRID,5,,.5\nGRID,6,,.5,.5\n"
    "GRID,7,,0.,.5\nGRID,8,,0.,0.,.5\nGRID,9,,.5,0.,.5\nGRID,10,,0.,.5,.5\n";

std::string bulk(std::string_view cards) {
  return "BEGIN BULK\n" + std::string(kGridCards) + std::string(cards) + "ENDDATA\n";
}

}  // namespace

TEST_CASE("a card of Nastran says the same in every form that people write it in") {
  const std::vector<std::string> forms = {
      "CTETRA,1,2,1,2,3,4,5,6,+\n+,7,8,9,10\n",
      "CTETRA         1       2       1       2       3       4       5       6\n"
      "               7       8       9      10\n",
      // as meshio names it
      "CTETRA_        1       2       1       2       3       4       5       6+11     \n"
      "+11            7       8       9      10\n",
      // comments and blank lines within
      "CTETRA         1       2       1       2       3       4       5       6\n"
      "$ the others\n\n   \n$\n               7       8       9      10\n",
      "CTETRA,1,2,1,2,3,4,5,6,+A\n$ here\n+A,7,8,9,10\n",
      // more than ten fields
      "CTETRA,1,2,1,2,3,4,5,6,7,8,9,10\n", "CTETRA,1,2,1,2,3,4,5,6,+,7,8,9,10\n",
      "CTETRA*,1,2,1,2,3,4,5,6,7,8,9,10\n",
      // without marks, with blanks before the comma
      "CTETRA, 1, 2, 1, 2, 3, 4, 5, 6\n, 7, 8, 9, 10\n",
      "CTETRA, 1, 2, 1, 2, 3, 4, 5, 6\n  , 7, 8, 9, 10\n",
      "  ctetra, 1, 2, 1, 2, 3, 4, 5, 6, X1\n+1, 7, 8, 9, 10\n",
      "CTETRA,1,2,1,2,3,4,5,6,11\n+11,7,8,9,10\n",
      // tabs
      "CTETRA\t1\t2\t1\t2\t3\t4\t5\t6\n\t7\t8\t9\t10\n",
      "CTETRA  1       2\t1       2\t3\t4       5\t6\t+A\n+A\t7       8\t9\t10\n",
      // large fields
      "CTETRA*                1               2               1               2*\n"
      "*                      3               4               5               6*\n"
      "*                      7               8               9              10\n",
      "CTETRA*                1               2               1               2\n"
      "*                      3               4               5               6\n"
      "               7       8       9      10\n",
      "  CTETRA       1       2       1       2       3       4       5       6+\n"
      "+              7       8       9      10\n"};
  const TempFolder folder;
  const MeshData plain = read_as(folder, "a.bdf", bulk(forms[0]));
  REQUIRE(plain.other_elements.empty());
  REQUIRE(plain.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 2}});
  REQUIRE(plain.mid_nodes.size() == 6);
  for (const std::string& form : forms) {
    CAPTURE(form);
    const MeshData mesh = read_as(folder, "a.bdf", bulk(form));
    CHECK(same_mesh(mesh, plain));
    CHECK(mesh.mid_nodes == plain.mid_nodes);
    CHECK(mesh.tet_numbers == std::vector<std::int64_t>{1});
  }
}

TEST_CASE("continuations of Nastran are found by their marks, wherever they stand") {
  const TempFolder folder;
  const MeshData plain = read_as(
      folder, "a.bdf", bulk("CTETRA,1,2,1,2,3,4,5,6,+\n+,7,8,9,10\nFORCE,1,1,0,1.,1.,0.,0.\n"));
  const std::string first =
      "CTETRA         1       2       1       2       3       4       5       6+A1     \n";
  const std::string rest = "+A1            7       8       9      10\n";
  const std::string force = "FORCE,1,1,0,1.,1.,0.,0.\n";
  const std::string load =
      "SPC1           1     123       1       2       3       4       5       6S1\n";
  for (const std::string& cards :
       {first + force + rest, rest + force + first, force + rest + "$ c\n" + first,
        first + load + rest + "+1             7\n" + force}) {
    CAPTURE(cards);
    const MeshData mesh = read_as(folder, "a.bdf", bulk(cards));
    CHECK(mesh.tets == plain.tets);
    CHECK(mesh.mid_nodes == plain.mid_nodes);
    CHECK(mesh.other_elements.empty());
    CHECK(notes_but_of_orders(mesh).empty());
  }
  // Others that go with their cards stay word for word.
  const MeshData mesh =
      read_as(folder, "a.bdf", bulk(load + force + first + rest + "+1             7\n"));
  CHECK(mesh.deck[formats::nastran_cards] == load + "+1             7\n" + force);
}

TEST_CASE("lines of Nastran whose marks go round in circles are told or stay") {
  const TempFolder folder;
  const std::string circle =
      "+A             7       8       9      10       1       1       1       1+B\n"
      "+C             1\n"
      "+B             7       8       9      10       1       1       1       1+A\n";
  const std::string twice =
      "SPC1           1     123       1       2       3       4       5       6+A\n"
      "SPC1           2     123       1       2       3       4       5       6+A\n"
      "PSOLID,2,1\n";
  for (const std::string& cards : {circle, twice + circle, circle + twice, circle + circle}) {
    CAPTURE(cards);
    write_text(folder / "a.bdf", bulk(cards));
    const std::string said = error_of_reading(folder / "a.bdf");
    if (said != "no error") {
      CHECK(said.find("a continuation without a card") != std::string::npos);
      continue;
    }
    write_mesh(folder / "b.bdf", read_mesh(folder / "a.bdf"));
    const std::string written = test::read_text(folder / "b.bdf");
    for (const std::string_view line : {"+A      ", "+B      ", "+C      "}) {
      CHECK(written.find(line) != std::string::npos);
    }
  }
}

TEST_CASE("a mid-side node of Nastran that is 0 is left out") {
  const TempFolder folder;
  const MeshData none = read_as(folder, "a.bdf", bulk("CTETRA,1,2,1,2,3,4,0,0,+\n+,0,0,0,0\n"));
  CHECK(none.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 2}});
  CHECK(none.mid_nodes.empty());
  CHECK(notes_but_of_orders(none).empty());
  const MeshData some = read_as(folder, "a.bdf", bulk("CTETRA,1,2,1,2,3,4,5,0,+\n+,7,8,9,10\n"));
  CHECK(some.tets.empty());
  CHECK(notes_but_of_orders(some).size() == 1);
}

TEST_CASE("what follows another BEGIN of a deck of Nastran is not read, and stays") {
  const TempFolder folder;
  const std::string rest = "BEGIN SUPER=1\nGRID,1,,9.,9.,9.\nCTETRA,1,1,1,2,3,4\nENDDATA\n";
  const MeshData mesh = read_as(
      folder, "a.bdf", "BEGIN BULK\n" + std::string(kGridCards) + "CTETRA,1,2,1,2,3,4\n" + rest);
  CHECK(mesh.tets.size() == 1);
  CHECK(mesh.points[0] == Point(0, 0, 0));
  CHECK(notes_but_of_orders(mesh) ==
        std::vector<std::string>{
            "the bulk data of superelements stay as they are: what they say is not read"});
  write_mesh(folder / "b.bdf", mesh);
  CHECK(test::read_text(folder / "b.bdf").ends_with(rest));
}

TEST_CASE("points of Nastran that repeat the card before are an error, other cards stay") {
  const TempFolder folder;
  write_text(folder / "a.bdf", "BEGIN BULK\nGRID,1,,0.,0.,0.\n=,*1,=,*1.,==\n=2\nENDDATA\n");
  CHECK(
      error_of_reading(folder / "a.bdf")
          .starts_with("a.bdf:3: points and elements that repeat the card before cannot be read"));
  CHECK(read_as(folder, "a.bdf", bulk("SPC,1,1,123\n=,=,2,==\nCTETRA,1,2,1,2,3,4\n"))
            .deck[formats::nastran_cards] == "SPC,1,1,123\n=,=,2,==\n");
}

TEST_CASE("a deck of Nastran from Windows keeps its line breaks, and gets no others") {
  const TempFolder folder;
  std::string windows;
  for (const char c : "SOL 101\nCEND\n" + bulk("CTETRA,1,2,1,2,3,4\nPSOLID,2,1\n")) {
    windows += c == '\n' ? "\r\n" : std::string(1, c);
  }
  write_mesh(folder / "b.bdf", read_as(folder, "a.bdf", windows));
  const std::string written = test::read_text(folder / "b.bdf");
  CHECK(written.find("PSOLID,2,1\r\nENDDATA\r\n") != std::string::npos);
  CHECK(std::count(written.begin(), written.end(), '\n') ==
        std::count(written.begin(), written.end(), '\r'));
}

TEST_CASE(
    "comments behind fields of Nastran stay with cards that stay, and are told where they do not") {
  const TempFolder folder;
  const MeshData mesh =
      read_as(folder, "a.bdf",
              bulk("CTETRA,1,2,1,2,3,4 $ lost\nCTETRA,2,2,1,2,3,4,5,6,+ $ lost\n+,7,8,9,10 $ too\n"
                   "GRID,11,,9.,0.,0.,5 $ kept\nCTRIA3,3,1,1,2,3,45. $ kept\nPSOLID,2,1 $ kept\n"));
  CHECK(notes_but_of_orders(mesh) ==
        std::vector<std::string>{
            "comments behind the fields of points and elements are not kept: 2"});
  write_mesh(folder / "b.bdf", mesh);
  const std::string written = test::read_text(folder / "b.bdf");
  for (const std::string_view line :
       {"GRID,11,,9.,0.,0.,5 $ kept\n", "CTRIA3,3,1,1,2,3,45. $ kept\n", "PSOLID,2,1 $ kept\n"}) {
    CHECK(written.find(line) != std::string::npos);
  }
}

TEST_CASE("new points and elements of a deck of Nastran get no number that one had before") {
  const TempFolder folder;
  MeshData mesh = read_as(folder, "a.bdf", bulk("CTETRA,5,2,1,2,3,4\nCTETRA,9,2,1,2,3,5\n"));
  mesh.tet_numbers[1] = 0;
  mesh.point_numbers[9] = 0;
  write_mesh(folder / "b.bdf", mesh);
  const MeshData again = read_mesh(folder / "b.bdf");
  CHECK(again.tet_numbers == std::vector<std::int64_t>{5, 10});
  CHECK(again.point_numbers.back() == 11);
}

TEST_CASE("a deck of Nastran that holds a mesh alone is no deck to miss") {
  const TempFolder folder;
  const auto lost = [&](std::string_view cards) {
    return not_written(folder / "a.vtu", read_as(folder, "a.bdf", bulk(cards)));
  };
  CHECK(lost("CTETRA,5,2,1,2,3,4\n").empty());
  CHECK(lost("CTETRA,5,2,1,2,3,4\nPSOLID,2,1\n") ==
        std::vector<std::string>{
            "1 pieces of a deck, all that is no mesh, are not kept: .vtu has no place for them"});
}

TEST_CASE("a tab behind a full field of Nastran ends it, one behind blanks goes to the next") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.bdf",
                                "BEGIN BULK\nGRID\t1\t\t1.234567\t-2.34567\t3.\n"
                                "GRID    2       \t5.\t6.\nENDDATA\n");
  CHECK(mesh.points == std::vector<Point>{{1.234567, -2.34567, 3}, {5, 6, 0}});
}

TEST_CASE("comments within a card of Nastran stay, whether it is written anew or as it is") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.bdf",
                                bulk("CTETRA,1,2,1,2,3,4,5,6,+\n$ of a tet\n+,7,8,9,10\n"
                                     "FORCE   2       1       0       1.0     0.0\n\n$ of a load\n"
                                     "        1.0     0.0\n"));
  CHECK(mesh.deck[formats::nastran_cards] ==
        "$ of a tet\nFORCE   2       1       0       1.0     0.0\n\n$ of a load\n"
        "        1.0     0.0\n");
}

TEST_CASE("an element of Nastran that leaves out mid-side nodes stays as it is, with a note") {
  const TempFolder folder;
  const std::string partial =
      "CTETRA         1       2       1       2       3       4       5        \n"
      "               7       8       9      10\n";
  const MeshData mesh = read_as(folder, "a.bdf",
                                bulk("CTETRA,2,2,1,2,3,4,5,6,+\n+,7,8,9,10\n"
                                     "CTRIA6,3,2,1,2,3,5,,7\n" +
                                     partial));
  CHECK(mesh.tets.size() == 1);
  REQUIRE(mesh.other_elements.size() == 1);
  CHECK(mesh.other_elements[0].vertices == std::vector<std::uint32_t>{0, 1, 2, 3});
  CHECK(mesh.triangles.size() == 1);
  CHECK(notes_but_of_orders(mesh) ==
        std::vector<std::string>{
            "1 CTETRA leave out some of their mid-side nodes: they stay as they are, and where "
            "they are",
            "1 CTRIA6 leave out some of their mid-side nodes: they stay as they are, and where "
            "they are"});
  write_mesh(folder / "b.bdf", mesh);
  const std::string written = test::read_text(folder / "b.bdf");
  CHECK(written.find(partial) != std::string::npos);
  CHECK(written.find("CTRIA6,3,2,1,2,3,5,,7\n") != std::string::npos);
}

TEST_CASE("a blank property of Nastran is no label, unless one has the number of the element") {
  const TempFolder folder;
  const std::string cards = "CTETRA,1,,1,2,3,4\nCTETRA,2,,1,2,3,5\nCTRIA3,3,,1,2,3\n";
  const MeshData none = read_as(folder, "a.bdf", bulk(cards));
  CHECK(none.tets[0].label == 0);
  CHECK(none.tets[1].label == 0);
  CHECK(none.triangles[0].label == 0);
  write_mesh(folder / "b.bdf", none);
  CHECK(test::read_text(folder / "b.bdf").find("CTETRA,2,,1,2,3,5\nCTRIA3,3,,1,2,3\n") !=
        std::string::npos);
  const MeshData with = read_as(folder, "a.bdf", bulk(cards + "PSOLID,2,1\nPSHELL,3,1,.1\n"));
  CHECK(with.tets[0].label == 0);
  CHECK(with.tets[1].label == 2);
  CHECK(with.triangles[0].label == 3);
}

TEST_CASE("points of Nastran in other coordinate systems are placed, and written in theirs again") {
  const std::vector<std::pair<std::string, Point>> systems = {
      {"CORD2R,7,,1.,2.,3.,1.,2.,4.,+\n+,1.,5.,3.\n", Point(1 - 1, 2 + 2, 3 + 60)},
      {"CORD2C,7,,1.,2.,3.,1.,2.,4.,+\n+,2.,2.,3.\n",
       Point(1 + 2 * std::cos(0.017453292519943295), 2 + 2 * std::sin(0.017453292519943295), 63)},
      {"CORD2S       7               0.      0.      0.      0.      0.      1.\n"
       "              1.      0.      0.\n",
       Point(2 * std::sin(0.017453292519943295) * 0.5,
             2 * std::sin(0.017453292519943295) * std::sqrt(0.75),
             2 * std::cos(0.017453292519943295))},
      {"CORD1R,7,1,4,2\n", Point(2, 1, 60)},
      {"CORD1C,6,1,4,3,7,1,4,2\n",
       Point(2 * std::cos(0.017453292519943295), 2 * std::sin(0.017453292519943295), 60)},
      // one in the other
      {"CORD2R,7,8,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\nCORD2R,8,,10.,0.,0.,10.,0.,1.,\n,11.,0.,0.\n",
       Point(12, 1, 60)}};
  const TempFolder folder;
  for (const auto& each : systems) {
    CAPTURE(each.first);
    const std::string card = "GRID,20,7,2.,1.,60.\n";
    MeshData mesh = read_as(folder, "a.bdf", bulk("CTETRA,1,2,1,2,3,20\n" + card + each.first));
    CHECK((mesh.points[10] - each.second).norm() < 1e-14 * 100);
    write_mesh(folder / "b.bdf", mesh);
    CHECK(test::read_text(folder / "b.bdf").find("\n" + card) != std::string::npos);
    CHECK(read_mesh(folder / "b.bdf").points == mesh.points);
    mesh.points[10] += Point(.25, .5, -.125);
    write_mesh(folder / "b.bdf", mesh);
    const std::string moved = test::read_text(folder / "b.bdf");
    CHECK(moved.find("GRID*                 20               7") != std::string::npos);
    CHECK((read_mesh(folder / "b.bdf").points[10] - mesh.points[10]).norm() < 1e-11);
  }
}

TEST_CASE("angles of 90 degrees in a system of Nastran give coordinates of 0") {
  const TempFolder folder;
  const MeshData mesh =
      read_as(folder, "a.bdf",
              bulk("CORD2C,7,,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\nGRID,20,7,2.,90.,1.\n"
                   "GRID,21,7,2.,-180.,1.\nGRID,22,7,2.,630.,1.\n"));
  CHECK(mesh.points[10] == Point(0, 2, 1));
  CHECK(mesh.points[11] == Point(-2, 0, 1));
  CHECK(mesh.points[12] == Point(0, -2, 1));
}

TEST_CASE("GRDSET gives a system to points without one, also to those before it, not to new ones") {
  const TempFolder folder;
  MeshData mesh = read_as(folder, "a.bdf",
                          bulk("GRDSET,,7,,,,,,\nGRID,20,0,0.,0.,5.\nCTETRA,1,2,1,2,3,20\n"
                               "CORD2R,7,,10.,0.,0.,10.,0.,1.,\n,11.,0.,0.\n"));
  CHECK(mesh.points[0] == Point(10, 0, 0));
  CHECK(mesh.points[10] == Point(0, 0, 5));
  mesh.points.emplace_back(1, 2, 3);
  mesh.point_numbers.push_back(0);
  mesh.tets.push_back({{0, 1, 2, 11}, 2});
  mesh.tet_numbers.push_back(0);
  write_mesh(folder / "b.bdf", mesh);
  CHECK(test::read_text(folder / "b.bdf").find("GRID,2,,1.\n") != std::string::npos);
  CHECK(read_mesh(folder / "b.bdf").points == mesh.points);
}

TEST_CASE(
    "what a deck of Nastran includes is read; files with something of the mesh are taken in") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "sub");
  write_text(folder / "sub" / "mesh.bdf",
             std::string(kGridCards) + "CTETRA,1,2,1,2,3,4\nENDDATA\n");
  write_text(folder / "loads.bdf", "$ loads\nSPC1,1,123,10\nSPC1,1,123,2\n");
  write_text(folder / "bars.bdf", "CBAR,900,1,1,2,0.,0.,1.\n");
  const MeshData mesh = read_as(folder, "a.bdf",
                                "SOL 101\nCEND\nBEGIN BULK\ninclude 'sub\\mesh.bdf' $ the mesh\n"
                                "INCLUDE loads.bdf\nINCLUDE \"bars\n.bdf\"\nPSOLID,2,1\nENDDATA\n");
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 2}});
  CHECK(mesh.required_vertices == std::vector<std::uint32_t>{0, 1, 9});  // CBAR, SPC1
  CHECK(mesh.deck[formats::nastran_cards] ==
        "INCLUDE loads.bdf\nCBAR,900,1,1,2,0.,0.,1.\nPSOLID,2,1\n");
  CHECK(notes_but_of_orders(mesh).size() == 1);
  CHECK(notes_but_of_orders(mesh)[0].find("mesh.bdf is not kept, nor what follows") !=
        std::string::npos);
  CHECK(not_written(folder / "b.bdf", mesh).empty());
  const auto elsewhere = not_written(folder / "sub" / "b.bdf", mesh);
  REQUIRE(elsewhere.size() == 1);
  CHECK(elsewhere[0].find("the files of INCLUDE stay in ") == 0);
  CHECK(source_files(folder / "a.bdf").size() == 4);
  write_mesh(folder / "b.bdf", mesh);
  const MeshData again = read_mesh(folder / "b.bdf");
  CHECK(same_mesh(again, mesh));
  CHECK(again.required_vertices == mesh.required_vertices);
}

TEST_CASE(
    "a file that a deck of Nastran includes and that is not there is noted, one in itself "
    "refused") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.bdf", bulk("INCLUDE 'gone.bdf'\n"));
  REQUIRE(notes_but_of_orders(mesh).size() == 1);
  CHECK(notes_but_of_orders(mesh)[0].find("what 'INCLUDE 'gone.bdf'' includes is not read: ") == 0);
  CHECK(mesh.deck[formats::nastran_cards] == "INCLUDE 'gone.bdf'\n");
  write_text(folder / "a.bdf", bulk("INCLUDE 'a.bdf'\n"));
  CHECK(error_of_reading(folder / "a.bdf").find("a.bdf:12: 'INCLUDE 'a.bdf'' includes itself") ==
        0);
  write_text(folder / "bad.bdf", "$\nCTETRA,1,2,1,2,3,99\n");
  write_text(folder / "a.bdf", bulk("INCLUDE 'bad.bdf'\n"));
  CHECK(error_of_reading(folder / "a.bdf").find("bad.bdf:2: '99' is not the number of a point") !=
        std::string::npos);
}

TEST_CASE("elements of two kinds may share a number in a deck of Nastran, and keep it") {
  const TempFolder folder;
  const MeshData mesh = read_as(
      folder, "a.bdf", bulk("CQUAD4,1,2,1,2,3,4,45.\nCTETRA,1,3,1,2,3,4\nCTRIA3,1,3,1,2,3\n"));
  CHECK(notes_but_of_orders(mesh).size() == 1);
  write_mesh(folder / "b.bdf", mesh);
  const std::string written = test::read_text(folder / "b.bdf");
  CHECK(written.find("CTETRA,1,3,1,2,3,4\n") != std::string::npos);
  CHECK(written.find("CTRIA3,1,3,1,2,3\n") != std::string::npos);
  CHECK(written.find("CQUAD4,1,2,1,2,3,4,45.\n") != std::string::npos);
}

TEST_CASE("coordinates of Nastran have fixed fields where they fit, and all digits where not") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 1, -0.5},
                 {-1.23456789012e-7, 123456.789012345, -12345678901234.0},
                 {1e-300, -4e200, 1.2345678901e-10},
                 {0.1234567890123456, 1, 2}};
  mesh.tets = {{{0, 1, 2, 3}, 1}};
  write_mesh(folder / "a.bdf", mesh);
  CHECK(test::read_text(folder / "a.bdf")
            .find("GRID*                  1                              0.              1.\n"
                  "*                   -0.5\n"
                  "GRID*                  2                -1.23456789012-7123456.789012345\n"
                  "*       -12345678901234.\n"
                  "GRID*                  3                         1.e-300        -4.e+200\n"
                  "*       1.2345678901e-10\n"
                  "GRID*,4,,0.1234567890123456,1.\n*,2.\n") != std::string::npos);
  MeshData again = read_mesh(folder / "a.bdf");
  CHECK(again.points == mesh.points);
  // A point that was in a deck and moved has as many digits as solvers read; others stay.
  again.points[0] = {1.0 / 3, -2.0 / 3, 1e-5 / 3};
  write_mesh(folder / "b.bdf", again);
  CHECK(test::read_text(folder / "b.bdf")
            .find("GRID*                  1                .333333333333333-.66666666666667\n"
                  "*       3.333333333333-6\n") != std::string::npos);
  const MeshData moved = read_mesh(folder / "b.bdf");
  for (std::size_t i = 1; i < 4; ++i) CHECK(moved.points[i] == mesh.points[i]);
}

TEST_CASE("a deck of Nastran with a byte changed or cut away never crashes") {
  const TempFolder folder;
  write_text(folder / "a.bdf", nastran_text());
  change_each_byte(folder / "a.bdf", folder / "a.bdf");
  cut_at_each_byte(folder / "a.bdf");
}

TEST_CASE("a tet of a deck of Nastran is located by its line") {
  const TempFolder folder;
  write_text(folder / "a.bdf", nastran_text());
  CHECK(locate_tet(folder / "a.bdf", 1).ends_with("a.bdf:15"));
}

TEST_CASE("a bad deck of Nastran is refused with line and reason") {
  const std::string good = nastran_text();
  const std::vector<BadFile> files = {
      {"other", "solid x\n", "2: ", "the file has no points: expected GRID"},
      {"no point", replaced(good, "CTETRA,5,,20", "CTETRA,5,,21"),
       "15: ", "'21' is not the number of a point: expected one of GRID"},
      {"few", replaced(good, "CTETRA,5,,20,30,40,110", "CTETRA,5,,20,30,40"),
       "15: ", "'' is not an integer: expected the number of a point"},
      {"high order",
       replaced(good, "+A      70      80      90      100",
                "+A      70      80      90      100     110"),
       "9: ", "CTETRA has more than 10 points"},
      {"point twice", replaced(good, "GRID,70", "GRID,60"),
       "25: ", "the number '60' of a point appears for the second time"},
      {"element twice", replaced(good, "CTRIA3  15", "CTRIA3  9 "),
       "12: ", "the number '9' of an element appears for the second time"},
      {"text", replaced(good, "GRID,60,,1,.5", "GRID,60,,1,.x"),
       "24: ", "'.x' is not a finite number: expected a coordinate"},
      {"coordinates", replaced(good, "GRID,60,,1", "GRID,60,2,1"),
       "24: ", "'2' is not the number of a coordinate system"},
      {"coordinates", replaced(good, "PARAM,POST,-1", "GRDSET,,2"),
       "18: ", "'2' is not the number of a coordinate system"},
      {"coordinates", replaced(good, "GRID,60,,1", "CORD2R,2,2,,,,,,1.,,,1.\nGRID,60,2,1"),
       "24: ", "the coordinate system '2' rests on itself"},
      {"coordinates", replaced(good, "GRID,60,,1", "CORD2R,2,,,,,,,1.,,,5.\nGRID,60,2,1"),
       "24: ", "the three points of the coordinate system '2' lie on a line"},
      {"coordinates", replaced(good, "GRID,60,,1", "CORD1S,2,10,20,31\nGRID,60,2,1"),
       "24: ", "'31' is not the number of a point"},
      {"coordinates", replaced(good, "PARAM,POST,-1", "CORD1C,2,10,20\nCORD1C,3,60,20,10"),
       "6: ", "'' is not the number of a point"},
      {"label", replaced(good, "CTETRA,5,,20", "CTETRA,5,3000000000,20"),
       "15: ", "'3000000000' is out of range: expected the number of a property"},
      {"number", replaced(good, "CTETRA,5,", "CTETRA,0,"), "15: ", "'0' is out of range"},
      {"repeated", replaced(good, "PARAM,POST,-1", "=,2,,1."),
       "6: ", "points and elements that repeat the card before cannot be read"},
      {"repeated", replaced(good, "GRID,70", "\n=,65,,1.\nGRID,70"),
       "26: ", "points and elements that repeat the card before cannot be read"},
      {"continuation", replaced(good, "PARAM,POST,-1", "+,1"),
       "6: ", "a continuation without a card"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.bdf", bad.content);
    const std::string error = error_of_reading(folder / "a.bdf");
    CHECK_MESSAGE(error.starts_with("a.bdf:" + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}

TEST_CASE("elements of property 0 keep it, which a blank field is not") {
  const TempFolder folder;
  const MeshData mesh =
      read_as(folder, "a.bdf", replaced(nastran_text(), "CTETRA,5,,20", "CTETRA,3,0,20"));
  write_mesh(folder / "b.bdf", mesh);
  CHECK(read_text(folder / "b.bdf").find("\nCTETRA,3,0,20,") != std::string::npos);
  CHECK(same_mesh(read_mesh(folder / "b.bdf"), mesh));
  MeshView view(mesh);
  view.set_variant("free");
  write_mesh(folder / "c.bdf", view);
  CHECK(read_text(folder / "c.bdf").find("\nCTETRA,3,0,20,") != std::string::npos);
}

TEST_CASE("the name of an included file that is too long for any is a file that is not there") {
  const TempFolder folder;
  const MeshData mesh = read_as(
      folder, "a.bdf",
      replaced(nastran_text(), "FORCE ", "INCLUDE '" + std::string(5000, 'x') + "'\nFORCE "));
  REQUIRE(!notes_but_of_orders(mesh).empty());
  CHECK(notes_but_of_orders(mesh)[0].find("includes is not read") != std::string::npos);
}

TEST_CASE("a deck asked for in short, long or free fields has them, and says the same") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {0.125, 0, 0}, {0, 1.0 / 3, 0}, {0, 0, -1.5e-12}};
  mesh.tets = {{{0, 1, 2, 3}, 4}};
  MeshView view(mesh);
  const std::map<std::string, std::string> beginnings = {
      {"short",
       "BEGIN BULK\nGRID           1              0.      0.      0.\n"
       "GRID           2           0.125      0.      0.\n"
       "GRID,3,,0.,0.3333333333333333,0.\n"},
      {"long",
       "BEGIN BULK\nGRID*                  1                              0.              0.\n"
       "*                     0.\n"},
      {"rounded",
       "BEGIN BULK\nGRID*                  1                              0.              0.\n"
       "*                     0.\n"},
      {"free",
       "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,0.125,0.,0.\nGRID,3,,0.,0.3333333333333333,0.\n"}};
  for (const auto& [name, beginning] : beginnings) {
    const std::string variant = name;  // a binding is not captured by CAPTURE of every compiler
    CAPTURE(variant);
    view.set_variant(variant);
    write_mesh(folder / "a.bdf", view);
    const std::string text = read_text(folder / "a.bdf");
    CHECK(text.substr(0, beginning.size()) == beginning);
    CHECK(text.find(variant == "free"
                        ? "CTETRA,1,4,1,2,3,4"
                        : "CTETRA         1       4       1       2       3       4\n") !=
          std::string::npos);
    if (variant != "rounded") CHECK(same_mesh(read_mesh(folder / "a.bdf"), mesh));
  }
}

TEST_CASE("cards of a deck that say more keep it in the form that is asked for") {
  const TempFolder folder;
  write_text(
      folder / "a.bdf",
      "CORD2R,5,,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\nGRID,1,5,0.,0.,0.,5,123\nGRID,2,,1.,0.,0.\n"
      "GRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\nENDDATA\n");
  const MeshData mesh = read_mesh(folder / "a.bdf");
  MeshView view(mesh);
  view.set_variant("short");
  write_mesh(folder / "b.bdf", view);
  CHECK(read_text(folder / "b.bdf")
            .find("GRID           1       5      0.      0.      0.       5     123\n") !=
        std::string::npos);
  CHECK(read_text(folder / "b.bdf").find("CORD2R,5,,0.") != std::string::npos);
}

TEST_CASE("rounded coordinates of Nastran have fixed fields alone, and are counted") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {0.125, 0, 0}, {1.0 / 3, -1e-5 / 3, 0}, {0, 0, 0.1234567890123456}};
  mesh.tets = {{{0, 1, 2, 3}, 4}};
  const std::filesystem::path file = folder / "a.bdf";
  CHECK(not_written(file, mesh).empty());
  CHECK(not_written(file, mesh, "free").empty());
  CHECK(not_written(file, mesh, "rounded") ==
        std::vector<std::string>{
            "3 coordinates are rounded to 16 characters, which is what solvers read"});
  MeshView view(mesh);
  view.set_variant("rounded");
  write_mesh(file, view);
  const std::string text = read_text(file);
  CHECK(text.find("GRID,") == std::string::npos);
  CHECK(text.find("GRID*,") == std::string::npos);
  CHECK(text.find(".333333333333333-3.33333333333-6\n") != std::string::npos);
  const MeshData again = read_mesh(file);
  CHECK(again.tets == mesh.tets);
  for (std::size_t i = 0; i < 4; ++i) CHECK((again.points[i] - mesh.points[i]).norm() < 1e-14);
  CHECK(not_written(file, again, "rounded").empty());
  // The card of a point that was read has them, too.
  const MeshData deck = read_as(
      folder, "a.bdf", replaced(kLinear, "GRID,30,,1.", "GRID,30,0,0.10000000000000001,,,,5"));
  MeshView of_deck(deck);
  of_deck.set_variant("rounded");
  write_mesh(file, of_deck);
  CHECK(read_text(file).find("GRID*                 30               0             0.1") !=
        std::string::npos);
}

TEST_CASE("who reads the coordinates of Nastran that need more than 16 characters is told") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {0.125, 0, 0}, {1.0 / 3, 0, 0}, {0, 0, 0.1234567890123456}};
  mesh.tets = {{{0, 1, 2, 3}, 4}};
  const auto remarks = [&](const MeshData& of, std::string_view variant) {
    return remarks_on_writing(folder / "a.bdf", of, variant);
  };
  REQUIRE(remarks(mesh, "").size() == 1);
  CHECK(remarks(mesh, "")[0].starts_with("2 points need more than 16 characters"));
  for (const std::string_view variant : {"free", "long", "short"}) {
    REQUIRE(remarks(mesh, variant).size() == 1);
    CHECK(remarks(mesh, variant)[0].find("solvers round free fields") != std::string::npos);
  }
  CHECK(remarks(mesh, "rounded").empty());
  MeshData fits = mesh;
  fits.points[2] = {0.25, 0, 0};
  fits.points[3] = {0, 0, 0.123456789012345};
  CHECK(remarks(fits, "").empty());
  CHECK(remarks(fits, "long").empty());
  fits.variant = mesh.variant = formats::kNastran;  // as the deck had it
  CHECK(remarks(mesh, "").empty());
}
