// SPDX-License-Identifier: MIT
// TetGen files: numbering, attributes, companions, and how bad files are refused.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const std::string kGoodNode = "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
const std::string kGoodEle = "1 4 0\n0 0 1 2 3\n";

struct TetgenFiles {
  std::string node = kGoodNode;
  std::string ele = kGoodEle;
  std::string face = {};
  std::string edge = {};
};

void write_files(const TempFolder& folder, const TetgenFiles& files) {
  write_text(folder / "a.node", files.node);
  write_text(folder / "a.ele", files.ele);
  if (!files.face.empty()) write_text(folder / "a.face", files.face);
  if (!files.edge.empty()) write_text(folder / "a.edge", files.edge);
}

MeshData read_tetgen_files(const TetgenFiles& files) {
  const TempFolder folder;
  write_files(folder, files);
  return read_mesh(folder / "a.ele");
}

}  // namespace

TEST_CASE("TetGen files that count from 1 with comments, attributes and markers are read") {
  const MeshData mesh = read_tetgen_files(
      {.node = "# nodes\n\n4  3  2  1  # counts\n 1  0 0 0  0.5 9 -1\n\n2 1 0 0 0 0 2\r\n"
               "3 0 1 0 0 0 0 # third\n4 0 0 1 0 0 3\n# end\n",
       .ele = "1 4 2\n1 1 2 3 4 -7.0 0.25\n",
       .face = "2 1\n1 1 2 3 5 -1 0\n2 4 2 3 6 1 2\n",
       .edge = "1 0\n1 3 4 17 18\n"});
  CHECK(mesh.points.size() == 4);
  CHECK(mesh.points[3] == Point(0, 0, 1));
  CHECK(mesh.point_labels == std::vector<Label>{-1, 2, 0, 3});
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, -7}});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, 5}, {{3, 1, 2}, 6}});
  CHECK(mesh.edges == std::vector<MeshData::Edge>{{{2, 3}, 0}});
  CHECK(mesh.point_data ==
        std::vector<DataArray>{{"attribute1", 1, std::vector<double>{0.5, 0, 0, 0}},
                               {"attribute2", 1, std::vector<double>{9, 0, 0, 0}}});
  CHECK(mesh.tet_data == std::vector<DataArray>{{"attribute2", 1, std::vector<double>{0.25}}});
  const TempFolder folder;
  write_mesh(folder / "b.ele", mesh);
  const MeshData again = read_mesh(folder / "b.node");
  CHECK(again.point_data == mesh.point_data);
  CHECK(again.tet_data == mesh.tet_data);
  CHECK(again.tets == mesh.tets);
}

TEST_CASE("TetGen files count as they did, or as is asked for") {
  const TempFolder folder;
  for (const int base : {0, 1}) {
    write_files(
        folder,
        {.node = fmt::format("4 3 0 0\n{} 0 0 0\n{} 1 0 0\n{} 0 1 0\n{} 0 0 1\n", base, base + 1,
                             base + 2, base + 3),
         .ele = fmt::format("1 4 0\n{} {} {} {} {}\n", base, base, base + 1, base + 2, base + 3),
         .face = fmt::format("1 0\n{} {} {} {}\n", base, base, base + 1, base + 2)});
    const MeshData mesh = read_mesh(folder / "a.ele");
    for (const std::string_view variant : {"", "from 0", "from 1"}) {
      const int wanted = variant.empty() ? base : variant.back() - '0';
      MeshView view(mesh);
      view.set_variant(variant);
      write_mesh(folder / "b.ele", view);
      CHECK(read_text(folder / "b.ele")
                .starts_with(fmt::format("1 4 0\n{} {} {} {} {}\n", wanted, wanted, wanted + 1,
                                         wanted + 2, wanted + 3)));
      CHECK(read_text(folder / "b.face")
                .starts_with(
                    fmt::format("1 1\n{} {} {} {} 0\n", wanted, wanted, wanted + 1, wanted + 2)));
      CHECK(read_mesh(folder / "b.node").points == mesh.points);
    }
  }
}

TEST_CASE("TetGen's order of the nodes of edges is that of its switch -o2") {
  // Nodes 5 to 10 are in the middle of the edges 3-4, 1-4, 1-2, 2-3, 2-4 and 1-3.
  const MeshData mesh =
      read_tetgen_files({.node = "10 3 0 0\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 0 0 2\n5 0 1 1\n"
                                 "6 0 0 1\n7 1 0 0\n8 1 1 0\n9 1 0 1\n10 0 1 0\n",
                         .ele = "1 10 1\n1 1 2 3 4 5 6 7 8 9 10 3\n",
                         .face = "1 1\n1 1 3 2 10 8 7 4\n",
                         .edge = "1 1\n1 1 2 7 -5\n"});
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 3}});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 2, 1}, 4}});
  CHECK(mesh.edges == std::vector<MeshData::Edge>{{{0, 1}, -5}});
  REQUIRE(mesh.mid_nodes.size() == 6);
  for (const auto& [a, b, node] : mesh.mid_nodes) {
    CHECK(mesh.points[node] == (mesh.points[a] + mesh.points[b]) / 2);
  }
  const TempFolder folder;
  write_mesh(folder / "b.ele", mesh);
  const MeshData again = read_mesh(folder / "b.node");
  CHECK(again.mid_nodes == mesh.mid_nodes);
  CHECK(again.triangles == mesh.triangles);
  CHECK(again.edges == mesh.edges);
}

TEST_CASE("TetGen's triangles and edges of second order that no tet has come back whole") {
  // Nodes 10 to 12 and 13 to 15 are no nodes of the tet.
  const std::string points =
      "5 0 1 1\n6 0 0 1\n7 1 0 0\n8 1 1 0\n9 1 0 1\n10 0 1 0\n11 9 0 0\n12 9 2 0\n"
      "13 9 0 2\n14 9 1 0\n15 9 1 1\n16 9 0 1\n";
  MeshData mesh =
      read_tetgen_files({.node = "16 3 0 0\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 0 0 2\n" + points,
                         .ele = "1 10 1\n1 1 2 3 4 5 6 7 8 9 10 3\n",
                         .face = "2 1\n1 11 12 13 14 15 16 7\n2 1 3 2 10 8 7 4\n",
                         .edge = "1 1\n1 11 12 14 -5\n"});
  CHECK(mesh.triangles.size() == 2);
  CHECK(mesh.edges.size() == 1);
  CHECK(mesh.mid_nodes.size() == 9);
  CHECK(not_written("b.ele", mesh).empty());
  const TempFolder folder;
  write_mesh(folder / "b.ele", mesh);
  const MeshData again = read_mesh(folder / "b.node");
  CHECK(again.mid_nodes == mesh.mid_nodes);
  CHECK(again.triangles == mesh.triangles);
  CHECK(again.edges == mesh.edges);
  SUBCASE("without nodes between they cannot be written, and that is said") {
    std::erase_if(mesh.mid_nodes, [](const auto& edge) { return edge[0] >= 10; });
    CHECK(not_written("b.ele", mesh) ==
          std::vector<std::string>{"2 triangles and edges without nodes between are not kept: .ele "
                                   "has no place for them"});
    write_mesh(folder / "b.ele", mesh);
    CHECK(read_mesh(folder / "b.ele").triangles.size() == 1);
    CHECK(read_mesh(folder / "b.ele").edges.empty());
  }
}

TEST_CASE("TetGen counts that are left out have their usual values") {
  const MeshData mesh = read_tetgen_files(
      {.node = "4\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n", .ele = "1\n0 0 1 2 3\n"});
  CHECK(mesh.tets.size() == 1);
}

TEST_CASE("a region attribute with a fraction is rounded to a label") {
  CHECK(read_tetgen_files({.ele = "1 4 1\n0 0 1 2 3 2.6\n"}).tets[0].label == 3);
  CHECK(read_tetgen_files({.ele = "1 4 1\n0 0 1 2 3 -2147483648.4\n"}).tets[0].label == INT32_MIN);
}

TEST_CASE("an edge file of an older mesh is emptied when a mesh without edges is written over it") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  mesh.required_vertices.clear();
  write_mesh(folder / "a.ele", mesh);
  CHECK(folder.entries() == 4);
  mesh.edges.clear();
  mesh.triangles.clear();
  write_mesh(folder / "a.ele", mesh);
  CHECK(same_mesh(read_mesh(folder / "a.node"), mesh));
  write_mesh(folder / "b.ele", mesh);
  CHECK(folder.entries() == 7);
}

TEST_CASE("a missing companion of a TetGen file is an error that names it") {
  const TempFolder folder;
  write_text(folder / "a.node", kGoodNode);
  CHECK(error_of_reading(folder / "a.node") == "a.ele: cannot be read: No such file or directory");
  write_text(folder / "b.ele", kGoodEle);
  CHECK(error_of_reading(folder / "b.ele") == "b.node: cannot be read: No such file or directory");
}

TEST_CASE("a bad TetGen file is refused with file, line, word and reason") {
  struct BadFiles {
    std::string what;
    TetgenFiles files;
    std::string place;
    std::string reason;
  };
  const std::vector<BadFiles> cases = {
      {"2D", {.node = "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n"}, "a.node:1: ", "expected dimension 3"},
      {"words",
       {.node = "four 3 0 0\n"},
       "a.node:1: ",
       "'four' is not an integer: expected the number of vertices"},
      {"huge", {.node = "99999999999 3 0 0\n"}, "a.node:1: ", "99999999999 vertices cannot fit"},
      {"negative", {.node = "-4 3 0 0\n"}, "a.node:1: ", "'-4' is out of range"},
      {"first is 2",
       {.node = "1 3 0 0\n2 0 0 0\n"},
       "a.node:2: ",
       "'2' is out of range: expected the number of the first vertex, 0 to 1"},
      {"gap",
       {.node = "2 3 0 0\n0 0 0 0\n2 0 0 0\n"},
       "a.node:3: ",
       "'2' is out of range: expected the next vertex, 1 to 1"},
      {"short line",
       {.node = "2 3 0 0\n0 0 0\n1 0 0 0 0 0\n"},
       "a.node:2: ",
       "the line ends where a coordinate is expected"},
      {"long line", {.node = "1 3 0 0\n0 0 0 0 5\n"}, "a.node:2: ", "'5' is too much"},
      {"long counts", {.node = "1 3 0 0 7\n0 0 0 0\n"}, "a.node:1: ", "'7' is too much"},
      {"too few",
       {.node = "2 3 0 0\n0 0 0 0\n   # the last is missing\n"},
       "a.node:4: ",
       "the file ends where a vertex is expected"},
      {"too many", {.node = kGoodNode + "4 1 1 1\n"}, "a.node:6: ", "'4' follows the last vertex"},
      {"text", {.node = "1 3 0 0\n0 0 0 1.0x\n"}, "a.node:2: ", "'1.0x' is not a number"},
      {"nan", {.node = "1 3 0 0\n0 0 0 nan\n"}, "a.node:2: ", "'nan' is not a finite number"},
      {"marker", {.node = "1 3 0 1\n0 0 0 0 1.5\n"}, "a.node:2: ", "'1.5' is not an integer"},
      {"cut", {.node = "1 3 0 0\n0 0 0 12"}, "a.node:2: ", "the file ends right behind '12'"},
      {"third order",
       {.ele = "1 20 0\n0 0 1 2 3 4 5 6 7 8 9\n"},
       "a.ele:1: ",
       "tetrahedra with 20 vertices cannot be read"},
      {"no such node",
       {.ele = "1 10 0\n0 0 1 2 3 4 5 6 7 8 9\n"},
       "a.ele:2: ",
       "'4' is out of range"},
      {"index 4",
       {.ele = "1 4 0\n0 0 1 2 4\n"},
       "a.ele:2: ",
       "'4' is out of range: expected a vertex number, 0 to 3"},
      {"index -1", {.ele = "1 4 0\n0 0 1 2 -1\n"}, "a.ele:2: ", "'-1' is out of range"},
      {"region",
       {.ele = "1 4 1\n0 0 1 2 3 1e10\n"},
       "a.ele:2: ",
       "the region attribute 10000000000 is out of range"},
      {"no region", {.ele = "1 4 1\n0 0 1 2 3\n"}, "a.ele:2: ", "the line ends where an attribute"},
      {"too many attributes", {.ele = "1 4 1001\n"}, "a.ele:1: ", "cannot fit"},
      {"more tets",
       {.ele = "1 4 0\n0 0 1 2 3\n1 0 1 2 3\n"},
       "a.ele:3: ",
       "'1' follows the last tetrahedron"},
      {"face marker",
       {.face = "1 1\n0 0 1 2\n"},
       "a.face:2: ",
       "the line ends where a boundary marker"},
      {"face index", {.face = "1 0\n0 0 1 7\n"}, "a.face:2: ", "'7' is out of range"},
      {"face count", {.face = "18446744073709551616 1\n"}, "a.face:1: ", "is out of range"},
      {"edge label",
       {.edge = "1 1\n0 2 3 2147483648\n"},
       "a.edge:2: ",
       "'2147483648' is out of range"},
  };
  for (const BadFiles& bad : cases) {
    CAPTURE(bad.what);
    const TempFolder folder;
    write_files(folder, bad.files);
    const std::string error = error_of_reading(folder / "a.node");
    CHECK_MESSAGE(error.starts_with(bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
