// SPDX-License-Identifier: MIT
// MEDIT text files: what is accepted and how bad files are refused.
#include <doctest/doctest.h>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const std::string kMeditPoints = "Vertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
const std::string kTets = "Tetrahedra\n1\n1 2 3 4 7\n";

}  // namespace

TEST_CASE("a MEDIT file with comments, odd white space and Windows line ends is read") {
  const MeshData mesh = read_as(
      "a.mesh",
      "\xEF\xBB\xBF# made by hand\r\n MeshVersionFormatted 1 # "
      "one\r\nDimension\r\n3\r\n\r\nVertices 4\r\n"
      "+0 0. .5 0  1D+00 0 0 0\r\n0 1e0 0 0\t0 0 1 +3 # four\r\nTetrahedra\r\n1 1 2 3 4 -7\r\nEnd");
  REQUIRE(mesh.points.size() == 4);
  CHECK(mesh.points[0] == Point(0, 0, 0.5));
  CHECK(mesh.points[1] == Point(1, 0, 0));
  CHECK(mesh.point_labels == std::vector<Label>{0, 0, 0, 3});
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, -7}});
}

TEST_CASE("sections of a MEDIT file may come in any order and End may be missing") {
  const MeshData mesh =
      read_as("a.mesh", kMeditHead + kTets +
                            "RequiredVertices\n1\n3\nTriangles\n1\n1 2 3 5\nEdges 1 1 4 6\n" +
                            kMeditPoints);
  CHECK(mesh.tets.size() == 1);
  CHECK(mesh.required_vertices == std::vector<std::uint32_t>{2});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, 5}});
  CHECK(mesh.edges == std::vector<MeshData::Edge>{{{0, 3}, 6}});
}

TEST_CASE("known sections that are not kept are passed over in a MEDIT file") {
  const MeshData mesh = read_as(
      "a.mesh", kMeditHead + "BoundingBox 0 0 0 1 1 1\nAngleOfCornerBound 45.5\n" + kMeditPoints +
                    "Corners\n2\n1\n2\nEdges 1 1 4 6\nRidges\n1\n1\nQuadrilaterals\n1\n1 2 3 4 "
                    "0\nHexahedra\n0\n"
                    "Comments\n2\nsome words here\nTime flies? no: words\nSolAtVertices\n4\n1 "
                    "1\n0.5\nnan\n-inf\n1e5\n"
                    "NormalAtVertices 1 1 1\nNormals 1 0 0 1\nTetrahedraP1Ordering 1 0 1 2 3\n"
                    "ParallelVertices 1\n1 2\n" +
                    kTets + "End\nanything");
  CHECK(mesh.tets.size() == 1);
  CHECK(mesh.groups == std::vector<Group>{{0, 0, "Corners", {}, {0, 1}},
                                          {1, 0, "Ridges", {}, {0}},
                                          {0, 0, "NormalAtVertices", {}, {0}}});
  CHECK(mesh.other_elements.size() == 1);
  CHECK(mesh.point_data ==
        std::vector<DataArray>{
            {"Normals", 3, std::vector<double>{0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}}});
  CHECK(mesh.notes.size() == 5);
  CHECK(mesh.notes.back() == "the section 'ParallelVertices' is not kept");
}

TEST_CASE("corners, ridges and what is required survive in MEDIT files of both kinds") {
  const TempFolder folder;
  write_text(folder / "a.mesh",
             kMeditHead + kMeditPoints + "Edges 1 1 4 6\nTriangles\n1\n1 2 3 5\n" +
                 "Corners 2\n1\n4\nRidges 1 1\nRequiredEdges 1 1\nRequiredTriangles 1\n1\n" +
                 kTets + "End\n");
  const MeshData mesh = read_mesh(folder / "a.mesh");
  CHECK(mesh.groups.size() == 4);
  CHECK(mesh.notes.empty());
  write_mesh(folder / "b.meshb", mesh);
  CHECK(read_mesh(folder / "b.meshb").groups == mesh.groups);
  write_mesh(folder / "c.mesh", read_mesh(folder / "b.meshb"));
  CHECK(read_mesh(folder / "c.mesh").groups == mesh.groups);
  CHECK(not_written(folder / "c.mesh", mesh).empty());
  CHECK(not_written(folder / "c.vtk", mesh).size() == 1);
  write_text(folder / "d.mesh", kMeditHead + kMeditPoints + kTets + "RequiredEdges 1\n1\nEnd\n");
  CHECK(error_of_reading(folder / "d.mesh").find("the number of what is marked") !=
        std::string::npos);
}

TEST_CASE(
    "sections of a MEDIT file that no mesh needs are dropped with a note where they are wrong") {
  const TempFolder folder;
  const std::string vectors = "Normals 2\n0 0 1\n0 1 0\nNormalAtVertices 2\n1 1\n2 2\n";
  const std::vector<std::pair<std::string, std::string>> wrong = {
      // MMG counts its tangents on from its normals.
      {"Tangents 1\n1 0 0\nTangentAtVertices 1\n1 3\n", "'3' is out of range"},
      {"TangentAtVertices 1\n1 1\n", "'1' is out of range"},
      {"Tangents 2\n1 0 0\nTangentAtVertices 1\n1 1\n", "'TangentAtVertices' is not a number"},
      {"Tangents 1\n1 0 0\nTangentAtVertices 1\n9 1\n", "'9' is out of range"},
      {"Ridges 1\n1\n", "'1' is out of range"}};
  for (const auto& each : wrong) {
    const std::string section = each.first;
    const std::string reason = each.second;
    CAPTURE(section);
    write_text(folder / "a.mesh", kMeditHead + kMeditPoints + vectors + section + kTets + "End\n");
    const MeshData mesh = read_mesh(folder / "a.mesh");
    CHECK(mesh.tets.size() == 1);
    CHECK(mesh.point_data.size() == 1);
    REQUIRE(mesh.groups.size() == 1);
    CHECK(mesh.groups[0].name == "NormalAtVertices");
    REQUIRE(mesh.notes.size() == 1);
    CHECK_MESSAGE(mesh.notes[0].find(reason) != std::string::npos, mesh.notes[0]);
    CHECK_MESSAGE(mesh.notes[0].find("a.mesh:") != std::string::npos, mesh.notes[0]);
  }
  for (const std::string section :
       {"Corners 1\n9\n", "RequiredEdges 1\n1\n", "RequiredTriangles 1\n1\n"}) {
    write_text(folder / "a.mesh", kMeditHead + kMeditPoints + section + kTets + "End\n");
    CHECK(error_of_reading(folder / "a.mesh").find("is out of range") != std::string::npos);
  }
  // The file is cut.
  write_text(folder / "a.mesh", kMeditHead + kMeditPoints + kTets + "Tangents 1\n1 0");
  CHECK(error_of_reading(folder / "a.mesh").find("truncated") != std::string::npos);
}

TEST_CASE("tets of first order beside those of second survive in MEDIT files of both kinds") {
  const TempFolder folder;
  write_text(folder / "a.mesh",
             "MeshVersionFormatted 2 Dimension 3 Vertices 11\n"
             "0 0 0 0  1 0 0 0  0 1 0 0  0 0 1 0  .5 0 0 0  .5 .5 0 0  0 .5 0 0  0 0 .5 0\n"
             ".5 0 .5 0  0 .5 .5 0  2 2 2 0\n"
             "TetrahedraP2 1\n1 2 3 4 5 6 7 8 9 10 1\nTetrahedra 1\n2 3 4 11 3\nEnd\n");
  const MeshData mesh = read_mesh(folder / "a.mesh");
  CHECK(mesh.tets.size() == 1);
  CHECK(mesh.other_elements.size() == 1);
  for (const char* name : {"b.mesh", "c.meshb"}) {
    write_mesh(folder / name, mesh);
    const MeshData again = read_mesh(folder / name);
    CHECK(again.tets == mesh.tets);
    CHECK(again.other_elements == mesh.other_elements);
  }
}

TEST_CASE("a bad MEDIT text file is refused with line, word and reason") {
  const std::string good = kMeditHead + kMeditPoints + kTets + "End\n";
  const std::vector<BadFile> files = {
      {"other format", "solid cube\n", ":1: ", "'solid' is not the beginning of a MEDIT file"},
      {"binary noise", std::string("\x01\0\0\0\x02", 5), ":1: ", "'\\x01\\x00\\x00\\x00\\x02'"},
      {"only comments", "# nothing\n\n", ":3: ", "the file is empty"},
      {"version 9", replaced(good, "ted 2", "ted 9"),
       ":1: ", "'9' is out of range: expected the version"},
      {"no dimension", replaced(good, "Dimension 3\n", ""),
       ":2: ", "'Vertices' is not expected here"},
      {"2D", replaced(good, "Dimension 3", "Dimension 2"), ":2: ", "expected Dimension 3"},
      {"unknown word", replaced(good, "Tetrahedra", "tetraeder"),
       ":9: ", "'tetraeder' is not expected here"},
      {"unknown section only", replaced(good, "Tetrahedra", "Tetraeder"), "",
       "the section Tetrahedra is missing"},
      {"no vertices", kMeditHead + kTets + "End\n", ":6: ", "the section Vertices is missing"},
      {"no tets", kMeditHead + kMeditPoints + "End\n", ":9: ", "the section Tetrahedra is missing"},
      {"twice", kMeditHead + kMeditPoints + kMeditPoints + kTets,
       ":9: ", "'Vertices' appears for the second time"},
      {"marks twice", kMeditHead + kMeditPoints + "Corners 1 1\nCorners 1 2\n" + kTets,
       ":10: ", "'Corners' appears for the second time"},
      {"too many rows", replaced(good, "Tetrahedra\n1\n", "Tetrahedra\n1\n4 3 2 1 0\n"),
       ":12: ", "'1' is not expected here"},
      {"too few rows", replaced(good, "Vertices\n4", "Vertices\n5"),
       ":9: ", "'Tetrahedra' is not a number"},
      {"index 0", replaced(good, "1 2 3 4 7", "1 2 0 4 7"),
       ":11: ", "'0' is out of range: expected a vertex number, 1 to 4"},
      {"index 5", replaced(good, "1 2 3 4 7", "1 2 5 4 7"), ":11: ", "'5' is out of range"},
      {"required 9", kMeditHead + kMeditPoints + "RequiredVertices\n1\n9\n" + kTets,
       ":11: ", "'9' is out of range"},
      {"text in number", replaced(good, "1 0 0 0", "1.0x 0 0 0"), ":6: ", "'1.0x' is not a number"},
      {"text in integer", replaced(good, "1 2 3 4 7", "1 2 3 4 12abc"),
       ":11: ", "'12abc' is not an integer"},
      {"nan", replaced(good, "1 0 0 0", "nan 0 0 0"), ":6: ", "'nan' is not a finite number"},
      {"inf", replaced(good, "1 0 0 0", "-inf 0 0 0"), ":6: ", "'-inf' is not a finite number"},
      {"overflow", replaced(good, "1 0 0 0", "1e999 0 0 0"),
       ":6: ", "'1e999' is not a finite number"},
      {"hexadecimal", replaced(good, "1 0 0 0", "0x1p3 0 0 0"), ":6: ", "'0x1p3' is not a number"},
      {"fraction", replaced(good, "1 2 3 4 7", "1 2.5 3 4 7"), ":11: ", "'2.5' is not an integer"},
      {"two signs", replaced(good, "1 2 3 4 7", "1 2 3 4 +-7"), ":11: ", "'+-7' is not an integer"},
      {"label", replaced(good, "1 2 3 4 7", "1 2 3 4 2147483648"),
       ":11: ", "'2147483648' is out of range"},
      {"long label", replaced(good, "1 2 3 4 7", "1 2 3 4 99999999999999999999"),
       ":11: ", "is out of range"},
      {"huge count", replaced(good, "Vertices\n4", "Vertices\n99999999999"),
       ":4: ", "99999999999 vertices cannot fit"},
      {"huge tets", replaced(good, "Tetrahedra\n1", "Tetrahedra\n9223372036854775807"),
       ":10: ", "cannot fit"},
      {"negative", replaced(good, "Tetrahedra\n1", "Tetrahedra\n-1"),
       ":10: ", "'-1' is out of range"},
      {"count of words", replaced(good, "Vertices\n4", "Vertices\nfour"),
       ":4: ", "'four' is not an integer"},
      {"hexahedra", kMeditHead + kMeditPoints + "Hexahedra\n1\n1 2 3 4 5 6 7 8 0\n" + kTets,
       ":11: ", "'5' is out of range"},
      {"third order", kMeditHead + kMeditPoints + "TetrahedraP3\n1\n1 2 3 4 0\n",
       ":9: ", "'TetrahedraP3' cannot be read"},
      {"cut in a number", kMeditHead + kMeditPoints + "Tetrahedra\n1\n1 2 3 4 7",
       ":11: ", "the file ends right behind '7'"},
      {"cut in rows", kMeditHead + kMeditPoints + "Tetrahedra\n2\n1 2 3 4 0\n1 2\n",
       ":10: ", "2 tetrahedra cannot fit into the 15 bytes"},
      {"cut in a row", kMeditHead + kMeditPoints + "Tetrahedra\n1\n1 2 3 4 \n",
       ":12: ", "the file ends where the reference of an element is expected"},
      {"long word", replaced(good, "1 0 0 0", std::string(100000, 'x')),
       ":6: ", "'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...'"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.mesh", bad.content);
    const std::string error = error_of_reading(folder / "a.mesh");
    CHECK_MESSAGE(error.starts_with("a.mesh" + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
