// SPDX-License-Identifier: MIT
// Netgen's files: surfaces and domains, edges, names, second order, what is kept word for word.
#include "kernel/formats/netgen.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "kernel/geometry.h"
#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;
using namespace tetmend::formats;

namespace {

/// Two tets that share a face, one of second order, a pyramid.
std::string netgen_text() {
  return "# by hand\n"
         "mesh3d\n"
         "dimension\n3\n"
         "geomtype\n11\n\n"
         "# surfnr bcnr domin domout np p1 p2 p3\n"
         "surfaceelementsgi\n4\n"
         " 4 1 1 0 3 1 3 2 7 8 9\n"
         " 5 2 1 2 3 2 3 4 1 1 1\n"
         " 5 2 2 0 4 1 2 5 4 1 2 3 4\n"
         " 6 9 2 0 6 1 2 4 10 9 6 6 5 4 3 2 1\n"
         "volumeelements\n4\n"
         "1 4 1 2 4 3\n"
         "2 4 2 3 5 4\n"
         "2 10 1 2 4 3 6 9 7 10 8 11\n"
         "2 5 1 2 5 4 3\n"
         "edgesegmentsgi2\n3\n"
         "1 0 1 2 11 12 4 6 3 0.25 0 1.5\n"
         "2 0 2 1 13 14 4 6 3 0.5 1 2\n"
         "2 0 2 3 15 16 4 5 8 0 0 0\n"
         "points\n11\n"
         "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n.5 0 0\n0 .5 0\n.5 .5 0\n0 0 .5\n.5 0 .5\n0 .5 .5\n"
         "pointelements\n1\n3 2\n"
         "identifications\n2\n1 2 1\n3 4 1\n"
         "identificationtypes\n1\n1\n"
         "materials\n2\n1 steel\n2 copper\n"
         "bcnames\n2\n1 default\n2\tinterface\n"
         "cd2names\n1\n3 rim\n"
         "cd3names\n1\n2 tip\n"
         "singular_points\n0\n"
         "face_colours\n1\n 1 0.5 0.5 0.5\n\n"
         "endmesh\n\n"
         "csgsurfaces 1\nsphere 4\n0 0 0 1\n";
}

std::vector<Group> sorted(std::vector<Group> groups) {
  std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return std::pair(a.dimension, a.number) < std::pair(b.dimension, b.number);
  });
  return groups;
}

bool same_netgen_extras(const MeshData& a, const MeshData& b) {
  return sorted(a.groups) == sorted(b.groups) && a.other_elements == b.other_elements &&
         a.triangle_data == b.triangle_data && a.edge_data == b.edge_data &&
         a.periodic == b.periodic && a.deck == b.deck && a.variant == b.variant;
}

template <class T>
std::vector<T> values(const std::vector<DataArray>& arrays, std::string_view name) {
  for (const DataArray& array : arrays) {
    if (array.name == name) return std::get<std::vector<T>>(array.values);
  }
  return {};
}

/// Two tets of two labels with a triangle between them and one outside.
MeshData glued() {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tets = {{{0, 1, 2, 3}, 1}, {{1, 2, 3, 4}, 2}};
  mesh.triangles = {{{1, 2, 3}, 5}, {{3, 2, 1}, 5}, {{0, 1, 2}, 7}};
  mesh.edges = {{{1, 2}, 4}};
  return mesh;
}

}  // namespace

TEST_CASE("a file of Netgen gives elements with labels, and its names as groups") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.vol", netgen_text());
  CHECK(mesh.points.size() == 11);
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 1}, {{1, 2, 3, 4}, 2}});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 2, 1}, 1}, {{1, 2, 3}, 2}});
  CHECK(mesh.edges == std::vector<MeshData::Edge>{{{0, 1}, 3}, {{1, 2}, 8}});
  CHECK(values<std::int32_t>(mesh.triangle_data, kNetgenSurface) ==
        std::vector<std::int32_t>{4, 5});
  CHECK(values<std::int32_t>(mesh.triangle_data, kNetgenOutside) ==
        std::vector<std::int32_t>{0, 2});
  CHECK(values<double>(mesh.edge_data, kNetgenSegments) ==
        std::vector<double>{1, 1,  11, 12, 4, 6, 3, 0.25, 0, 1.5,  //
                            2, -1, 13, 14, 4, 6, 3, 0.5,  1, 2,    //
                            2, 1,  15, 16, 4, 5, 8, 0,    0, 0,    //
                            0, 0,  0,  0,  0, 0, 0, 0,    0, 0});
  const std::vector<Group> groups = {{0, 2, "tip", {}, {2}},
                                     {1, 3, "rim", {}, {}},
                                     {2, 2, "interface", {}, {}},
                                     {3, 1, "steel", {}, {}},
                                     {3, 2, "copper", {}, {}}};
  CHECK(sorted(mesh.groups) == groups);
  CHECK(mesh.periodic == std::vector<PeriodicLink>{{2, 1, 0, {}, {{{0, 1}}, {{2, 3}}}}});
  const std::vector<std::string> deck = {"geomtype\n11\n", "identificationtypes\n1\n1\n",
                                         "face_colours\n1\n 1 0.5 0.5 0.5\n",
                                         "endmesh\n\ncsgsurfaces 1\nsphere 4\n0 0 0 1\n"};
  CHECK(mesh.deck == deck);
  CHECK(notes_but_of_orders(mesh) ==
        std::vector<std::string>{"the section 'singular_points' is not kept"});
}

TEST_CASE(
    "middle points of Netgen's elements of second order lie on the edges where VTK has them") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.vol", netgen_text());
  const auto check_middles = [&](int type, const std::vector<std::array<std::size_t, 2>>& edges) {
    for (const OtherElements& others : mesh.other_elements) {
      if (others.vtk_type != type) continue;
      const auto point = [&](std::size_t k) { return mesh.points[others.vertices[k]]; };
      for (std::size_t k = 0; k < edges.size(); ++k) {
        CHECK(point(others.vertex_count - edges.size() + k) ==
              (point(edges[k][0]) + point(edges[k][1])) / 2);
      }
      if (type == 24) CHECK(volume6(point(0), point(1), point(2), point(3)) > 0);
      return true;
    }
    return false;
  };
  CHECK(check_middles(24, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}));
  CHECK(check_middles(22, {{0, 1}, {1, 2}, {2, 0}}));
}

TEST_CASE("what a file of Netgen holds survives writing, and the second time with the same bytes") {
  const TempFolder folder;
  for (const bool with_parameters : {false, true}) {
    CAPTURE(with_parameters);
    std::string content = netgen_text();
    if (with_parameters) {
      content = replaced(content, "surfaceelementsgi", "surfaceelementsuv");
      content = replaced(content, "7 8 9\n", "7 8 9 .1 .2 .3\n");
      content = replaced(content, "1 1 1\n", "1 1 1 1 1 1\n");
      content = replaced(content, "1 2 3 4\n", "1 2 3 4 5 6 7 8\n");
      content = replaced(content, "6 5 4 3 2 1\n", "6 5 4 3 2 1 6 5 4 3 2 1\n");
    }
    const MeshData mesh = read_as(folder, "a.vol", content);
    CHECK(not_written(folder / "b.vol", mesh).empty());
    write_mesh(folder / "b.vol", mesh);
    const MeshData again = read_mesh(folder / "b.vol");
    CHECK(same_mesh(again, mesh));
    CHECK(same_netgen_extras(again, mesh));
    write_mesh(folder / "c.vol", again);
    CHECK(test::read_text(folder / "b.vol") == test::read_text(folder / "c.vol"));
  }
}

TEST_CASE("domains beside triangles of other formats are found from the tets for Netgen") {
  const TempFolder folder;
  MeshData mesh = glued();
  write_mesh(folder / "a.vol", mesh);
  const MeshData again = read_mesh(folder / "a.vol");
  CHECK(same_mesh(again, mesh));
  CHECK(values<std::int32_t>(again.triangle_data, kNetgenInside) ==
        std::vector<std::int32_t>{1, 2, 0});
  CHECK(values<std::int32_t>(again.triangle_data, kNetgenOutside) ==
        std::vector<std::int32_t>{2, 1, 1});
  CHECK(values<std::int32_t>(again.triangle_data, kNetgenSurface) ==
        std::vector<std::int32_t>{1, 2, 3});
  // All three triangles have the edge.
  CHECK(values<double>(again.edge_data, kNetgenSegments).size() == 3 * kNetgenSegment);
}

TEST_CASE("tets are written as Netgen turns them, whichever way round most of them are") {
  const TempFolder folder;
  MeshData mesh = glued();
  std::swap(mesh.tets[0].vertices[0], mesh.tets[0].vertices[1]);
  write_mesh(folder / "a.vol", mesh);
  CHECK(read_mesh(folder / "a.vol").tets == mesh.tets);  // one of two stays inverted
  std::swap(mesh.tets[1].vertices[0], mesh.tets[1].vertices[1]);
  write_mesh(folder / "a.vol", mesh);
  const std::string text = test::read_text(folder / "a.vol");
  CHECK(text.find("\n1 4 2 1 3 4\n2 4 3 2 4 5\n") != std::string::npos);
  CHECK(values<std::int32_t>(read_mesh(folder / "a.vol").triangle_data, kNetgenInside)[0] == 1);
}

TEST_CASE("labels without a name are default for Netgen, and names are words") {
  const TempFolder folder;
  MeshData mesh = glued();
  mesh.groups = {{2, 7, "outer wall", {}, {}}, {0, 0, "lost", {}, {1}}};
  write_mesh(folder / "a.vol", mesh);
  CHECK(test::read_text(folder / "a.vol").find("bcnames\n7\n1 default\n") != std::string::npos);
  CHECK(read_mesh(folder / "a.vol").groups == std::vector<Group>{{2, 7, "outer_wall", {}, {}}});
  CHECK(not_written(folder / "a.vol", mesh) ==
        std::vector<std::string>{
            "1 groups, with their names, are not kept: .vol has no place for them",
            "names of groups are not kept as they are: .vol has other rules for 1 of them, the "
            "first is 'outer wall'"});
  // Two names may become one word.
  mesh.groups.push_back({2, 8, "outer_wall", {}, {}});
  mesh.triangles[0].label = 8;
  mesh.triangles[1].label = 7;
  write_mesh(folder / "b.vol", mesh);
  CHECK(test::read_text(folder / "b.vol").find("7 outer_wall_2\n8 outer_wall\n") !=
        std::string::npos);
}

TEST_CASE("older lists of edges are read from a file of Netgen with a note") {
  const TempFolder folder;
  std::string content = netgen_text();
  const std::size_t at = content.find("edgesegmentsgi2");
  content.replace(at, content.find("points\n11") - at, "edgesegments\n2\n1 0 1 2\n2 5 2 1 9\n");
  const MeshData mesh = read_as(folder, "a.vol", content);
  CHECK(mesh.edges.size() == 1);
  CHECK(mesh.notes[0] == "of 'edgesegments' only the points and surfaces are kept");
}

TEST_CASE("a file of Netgen with a byte changed or cut away never crashes") {
  const TempFolder folder;
  write_text(folder / "a.vol", netgen_text());
  change_each_byte(folder / "a.vol", folder / "a.vol");
  cut_at_each_byte(folder / "a.vol");
}

TEST_CASE("a tet of a file of Netgen is located by its line") {
  const TempFolder folder;
  write_text(folder / "a.vol", netgen_text());
  CHECK(locate_tet(folder / "a.vol", 1).ends_with("a.vol:18"));
}

TEST_CASE("a bad file of Netgen is refused with line and reason") {
  const std::string good = netgen_text();
  const std::vector<BadFile> files = {
      {"other", "solid x\n", "1: ", "'solid' is not the beginning of a mesh of Netgen"},
      {"plane", replaced(good, "dimension\n3", "dimension\n2"), "4: ", "expected dimension 3"},
      {"range", replaced(good, "2 4 2 3 5 4", "2 4 2 3 4 12"),
       "18: ", "'12' is out of range: expected a point number, 1 to 11"},
      {"zero", replaced(good, "2 4 2 3 5 4", "2 4 2 3 4 0"), "18: ", "'0' is out of range"},
      {"type", replaced(good, "2 5 1 2 5 4 3", "2 7 1 2 5 4 3"),
       "20: ", "volume elements with 7 points cannot be read: expected 4, 5, 6, 8 or 10"},
      {"type", replaced(good, " 4 1 1 0 3", " 4 1 1 0 5"),
       "11: ", "surface elements with 5 points cannot be read"},
      {"label", replaced(good, "2 4 2 3 5 4", "4294967296 4 2 3 4 5"),
       "18: ", "expected the number of a material"},
      {"text", replaced(good, "1 1 1\n.5", "1 a 1\n.5"), "32: ", "'a' is not a number"},
      {"infinite", replaced(good, "1 1 1\n.5", "1 nan 1\n.5"), "32: ", "expected a coordinate"},
      {"few", replaced(good, "volumeelements\n4", "volumeelements\n5"),
       "21: ", "'edgesegmentsgi2' is not an integer"},
      {"many", replaced(good, "volumeelements\n4", "volumeelements\n3"),
       "20: ", "'2' is not expected here: expected the name of a section"},
      {"huge", replaced(good, "volumeelements\n4", "volumeelements\n1000000000"),
       "16: ", "1000000000 elements cannot fit"},
      {"huge", replaced(good, "points\n11", "points\n1000000000"),
       "27: ", "1000000000 points cannot fit"},
      {"huge", replaced(good, "materials\n2", "materials\n1000000000"), "", "names cannot fit"},
      {"edge", replaced(good, "2 0 2 3 15 16 4 5 8", "2 0 2 3 15 16 4 5 8.5"),
       "25: ", "8.5 is not the number of an edge"},
      {"name", replaced(good, "1 steel", "1 blue steel"), "", "'steel' is too much"},
      {"name", replaced(good, "2 copper", "1 copper"), "", "the number 1 appears for the second"},
      {"twice", replaced(good, "cd3names", "cd2names"), "", "'cd2names' appears for the second"},
      {"no points", replaced(good, "points\n11", "pints\n11"), "", "out of range"},
      {"no end", replaced(good, "endmesh", "#ndmesh"), "",
       "the file ends where the name of a section or endmesh"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.vol", bad.content);
    const std::string error = error_of_reading(folder / "a.vol");
    CHECK_MESSAGE(error.starts_with("a.vol:" + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
