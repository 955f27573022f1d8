// SPDX-License-Identifier: MIT
// Files of Exodus II: blocks, sets, sides, numbers, variables, and tables that make no sense.
#include "kernel/formats/exodus.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/formats/netcdf_file.h"
#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Two blocks of a tet each and one of a shell, as Cubit and others write them.
struct SmallExodus {
  Reals coordinates = {0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, -1};
  Integers first = {1, 2, 3, 4}, second = {1, 3, 2, 5};
  std::string type = "tetra4";
  Integers blocks = {10, 20, 30};
  std::vector<std::string> names = {"left", "", "plate"};
  Integers side_elements = {1, 2}, sides = {1, 3};
  Integers nodes = {4, 5};
  Integers numbers = {7, 9, 11};
  Reals pressure = {1, 2, 3, 4, 5};
  Reals second_step = {-1, -1, -1, -1, -1};
  Integers of_polygons;  // how many nodes each element of the first block had, were it one of these

  void write(const std::filesystem::path& to) const {
    formats::NetcdfWriter file;
    file.attribute("title", std::string("a small one"));
    file.dimension("time_step", 0);
    file.dimension("num_dim", 3);
    file.dimension("len_name", 33);
    file.dimension("num_nodes", coordinates.size() / 3);
    file.dimension("three", 3);
    file.dimension("four_nodes", 4);
    for (const std::size_t size : {first.size() / 4, side_elements.size(), sides.size()}) {
      file.dimension(fmt::format("of_{}", size), size);
    }
    file.dimension("of_nodes", nodes.size());
    file.dimension("one", 1);
    file.dimension("num_el_blk", blocks.size());
    file.dimension("num_elem", numbers.size());
    file.add("coord", {"num_dim", "num_nodes"}, coordinates);
    file.add("eb_prop1", {"num_el_blk"}, blocks);
    file.add_texts("eb_names", {"num_el_blk", "len_name"}, names);
    file.add("connect1", {"one", "four_nodes"}, first, {{"elem_type", type}});
    if (!of_polygons.empty()) {
      file.dimension("num_polygons", of_polygons.size());
      file.add("ebepecnt1", {"num_polygons"}, of_polygons);
    }
    file.add("connect2", {"one", "four_nodes"}, second, {{"elem_type", "TET"}});
    file.add("connect3", {"one", "three"}, Integers{1, 2, 4}, {{"elem_type", "TRISHELL3"}});
    file.add("elem_num_map", {"num_elem"}, numbers);
    file.add("elem_ss1", {fmt::format("of_{}", side_elements.size())}, side_elements);
    file.add("side_ss1", {fmt::format("of_{}", sides.size())}, sides);
    file.add("ss_prop1", {"one"}, Integers{30});
    file.add("node_ns1", {"of_nodes"}, nodes);
    file.add("ns_prop1", {"one"}, Integers{5});
    file.add_texts("ns_names", {"one", "len_name"}, {"tips"});
    file.add_texts("name_nod_var", {"one", "len_name"}, {"p"});
    file.add("vals_nod_var1", {"time_step", "num_nodes"}, pressure);
    file.add("attrib1", {"one"}, Reals{0.5});
    OutputFile out(to);
    file.write(out);
    out.commit();
  }
};

std::vector<std::int64_t> integers_of(const std::filesystem::path& file, const std::string& table) {
  return formats::open_netcdf(formats::InputFile(file), "Exodus")->integers(table);
}

}  // namespace

TEST_CASE("a file of Exodus gives blocks as labels, side sets as triangles, sets as groups") {
  const TempFolder folder;
  SmallExodus().write(folder / "a.e");
  const MeshData mesh = read_mesh(folder / "a.e");
  CHECK(mesh.points.size() == 5);
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 10}, {{0, 2, 1, 4}, 20}});
  CHECK(mesh.tet_numbers == std::vector<std::int64_t>{7, 9});
  REQUIRE(mesh.triangles.size() == 2);  // the shell is side 1 of the first tet, too
  CHECK(mesh.triangles[0] == MeshData::Triangle{{0, 1, 3}, 1});  // the side set is 30, too
  CHECK(mesh.triangles[1] == MeshData::Triangle{{0, 4, 1}, 30});
  REQUIRE(find_group(mesh, "left") != nullptr);
  CHECK(find_group(mesh, "left")->dimension == 3);
  CHECK(find_group(mesh, "left")->number == 10);
  REQUIRE(find_group(mesh, "tips") != nullptr);
  CHECK(find_group(mesh, "tips")->members == std::vector<std::uint32_t>{3, 4});
  REQUIRE(mesh.point_data.size() == 1);
  CHECK(mesh.point_data[0] == DataArray{"p", 1, Reals{1, 2, 3, 4, 5}});
  CHECK(mesh.notes == std::vector<std::string>{"the tables 'attrib' are not kept"});
}

TEST_CASE("what a file of Exodus holds survives writing, and writing again gives the same bytes") {
  const TempFolder folder;
  SmallExodus().write(folder / "a.e");
  const MeshData mesh = read_mesh(folder / "a.e");
  CHECK(not_written(folder / "b.e", mesh).empty());
  const auto notes = not_written(folder / "b.msh", mesh);  // a shell block and a side set are 30
  CHECK(std::count(notes.begin(), notes.end(),
                   "1 numbers of blocks and sets that others have, too, are not kept: .msh has no "
                   "place for them") == 1);
  write_mesh(folder / "b.e", mesh);
  const MeshData again = read_mesh(folder / "b.e");
  CHECK(again.tets == mesh.tets);
  CHECK(again.triangles == mesh.triangles);
  CHECK(again.tet_numbers == mesh.tet_numbers);
  CHECK(again.point_data == mesh.point_data);
  CHECK(again.groups.size() == mesh.groups.size());
  for (const char* name : {"left", "plate", "tips"}) {
    REQUIRE(find_group(again, name) != nullptr);
    CHECK(find_group(again, name)->number == find_group(mesh, name)->number);
    CHECK(find_group(again, name)->members == find_group(mesh, name)->members);
  }
  CHECK(again.deck[0] == mesh.deck[0]);
  CHECK(integers_of(folder / "b.e", "eb_prop1") == std::vector<std::int64_t>{10, 20, 30});
  CHECK(integers_of(folder / "b.e", "ss_prop1") == std::vector<std::int64_t>{30});
  write_mesh(folder / "c.e", again);
  CHECK(read_text(folder / "b.e") == read_text(folder / "c.e"));
}

TEST_CASE(
    "elements of several kinds with one label are blocks of Exodus with numbers of their own") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 5, 5}};
  mesh.tets = {{{0, 1, 2, 3}, 1}};
  mesh.triangles = {{{0, 2, 1}, 2}, {{0, 1, 4}, 2}};
  mesh.edges = {{{0, 1}, 1}};
  CHECK(not_written(folder / "a.e", mesh) ==
        std::vector<std::string>{"2 labels change, for .e has a number for each block of one kind: "
                                 "2 of kind 'triangle' becomes 3"});
  write_mesh(folder / "a.e", mesh);
  CHECK(integers_of(folder / "a.e", "eb_prop1") == std::vector<std::int64_t>{1, 3, 4});
  CHECK(integers_of(folder / "a.e", "ss_prop1") == std::vector<std::int64_t>{2});
  const MeshData again = read_mesh(folder / "a.e");
  CHECK(again.notes.empty());
  CHECK(again.triangles == std::vector<MeshData::Triangle>{{{0, 1, 4}, 3}, {{0, 2, 1}, 2}});
  CHECK(again.edges[0].label == 4);
  write_mesh(folder / "b.e", again);
  CHECK(read_text(folder / "a.e") == read_text(folder / "b.e"));
}

TEST_CASE("a side set keeps its number beside a block of edges that has it") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{{0, 1, 2, 3}, 1}};
  mesh.triangles = {{{0, 2, 1}, 2}};
  mesh.edges = {{{0, 1}, 2}};
  CHECK(not_written(folder / "a.e", mesh).empty());
  write_mesh(folder / "a.e", mesh);
  const MeshData again = read_mesh(folder / "a.e");
  CHECK(again.notes.empty());
  CHECK(again.triangles == mesh.triangles);
  CHECK(again.edges == mesh.edges);
}

TEST_CASE("a side of a tet that is turned over is a side of the same tet after each writing") {
  const TempFolder folder;
  SmallExodus small;
  small.coordinates[13] = -0.5;  // both tets lie below their common face
  small.side_elements = {1};
  small.sides = {4};
  small.write(folder / "a.e");
  write_mesh(folder / "b.e", read_mesh(folder / "a.e"));
  write_mesh(folder / "c.e", read_mesh(folder / "b.e"));
  CHECK(read_text(folder / "b.e") == read_text(folder / "c.e"));
}

TEST_CASE("vectors are three variables of Exodus, and an array again when they are read") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  const std::size_t count = mesh.points.size();
  Reals values(3 * count);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i) / 7;
  mesh.point_data = {{"v", 3, values}, {"ids", 1, std::vector<std::int64_t>(count, INT64_MAX)}};
  write_mesh(folder / "a.exo", mesh);
  const MeshData again = read_mesh(folder / "a.exo");
  REQUIRE(again.point_data.size() == 2);
  CHECK(again.point_data[0] == mesh.point_data[0]);
  const std::vector<std::string> lost = not_written(folder / "a.exo", mesh);
  CHECK(std::find(lost.begin(), lost.end(),
                  "integers of the array 'ids' are rounded: .e has real numbers") != lost.end());
}

TEST_CASE("tables of Exodus that make no sense are refused with the table and the reason") {
  struct Case {
    std::function<void(SmallExodus&)> spoil;
    std::string reason;
  };
  const std::vector<Case> cases = {
      {[](SmallExodus& m) { m.first[3] = 6; }, "'/connect1': '6' in element 1 is not the number"},
      {[](SmallExodus& m) { m.second[0] = 0; }, "'/connect2': '0' in element 1 is not the number"},
      {[](SmallExodus& m) { m.type = "NFACED"; }, "'/connect1': volume elements of type 'NFACED'"},
      {[](SmallExodus& m) { m.coordinates[7] = std::nan(""); }, "of point 3 is not finite"},
      {[](SmallExodus& m) {
         m.sides = {1, 5};
       },
       "'/side_ss1': '5' in row 2 is no side"},
      {[](SmallExodus& m) {
         m.side_elements = {1, 4};
       },
       "'/elem_ss1': '4' is not the number"},
      {[](SmallExodus& m) {
         m.nodes = {4, 6};
       },
       "'/node_ns1': '6' is not the number of a node"}};
  for (const Case& bad : cases) {
    CAPTURE(bad.reason);
    const TempFolder folder;
    SmallExodus small;
    bad.spoil(small);
    small.write(folder / "a.e");
    const std::string error = error_of_reading(folder / "a.e");
    CHECK(error.starts_with("a.e: '/"));
    CHECK(error.find(bad.reason) != std::string::npos);
  }
}

TEST_CASE("a group of no points is not written to Exodus, where it would be a table of all steps") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  Group empty;
  empty.dimension = 0;
  empty.name = "nothing";
  empty.number = 77;
  mesh.groups.push_back(empty);
  write_mesh(folder / "a.e", mesh);
  CHECK(read_mesh(folder / "a.e").tets.size() == mesh.tets.size());
  const std::vector<std::string> lost = not_written(folder / "a.e", mesh);
  CHECK(std::any_of(lost.begin(), lost.end(), [](const std::string& note) {
    return note.find("the group 'nothing' of no points is not kept") != std::string::npos;
  }));
}

TEST_CASE("counts of polygons beside tets of Exodus do not say how many tets there are") {
  const TempFolder folder;
  SmallExodus small;
  small.of_polygons = Integers(1000, 4);
  small.write(folder / "a.e");
  CHECK(read_mesh(folder / "a.e").tets.size() == 2);
}

TEST_CASE("variables of Exodus without a step are told, and the mesh is read") {
  const TempFolder folder;
  SmallExodus().write(folder / "a.e");
  std::string bytes = read_text(folder / "a.e");
  for (const std::size_t k : {4, 5, 6, 7}) bytes[k] = '\0';  // how many steps there are
  write_text(folder / "a.e", bytes);
  const MeshData mesh = read_mesh(folder / "a.e");
  CHECK(mesh.tets.size() == 2);
  CHECK(mesh.point_data.empty());
  CHECK(std::any_of(mesh.notes.begin(), mesh.notes.end(), [](const std::string& note) {
    return note == "the variables are not kept: they have no step";
  }));
}

TEST_CASE(
    "points of Exodus without elements come back; points of another netCDF file are refused") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 2, 3}};
  write_mesh(folder / "a.e", mesh);
  CHECK(read_mesh(folder / "a.e").points == mesh.points);
  std::string bytes = read_text(folder / "a.e");
  bytes[bytes.find("api_version")] = 'b';
  write_text(folder / "a.e", bytes);
  CHECK(error_of_reading(folder / "a.e").find("the file has no elements") != std::string::npos);
}

TEST_CASE("of the steps of a variable of Exodus the first is read, and no other is looked at") {
  const TempFolder folder;
  SmallExodus().write(folder / "a.e");
  std::string bytes = read_text(folder / "a.e");
  bytes[7] = 3;  // how many steps there are; the second one ends too early, the third is not there
  write_text(folder / "a.e", bytes + std::string(20, '\x41'));
  const MeshData mesh = read_mesh(folder / "a.e");
  REQUIRE(mesh.point_data.size() == 1);
  CHECK(mesh.point_data[0] == DataArray{"p", 1, Reals{1, 2, 3, 4, 5}});
}

TEST_CASE("names of up to 255 bytes come back whole from Exodus, longer ones are told") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  mesh.groups.clear();
  const std::size_t count = mesh.points.size();
  const std::string long_name(100, 'n');
  mesh.point_data = {{long_name + "1", 1, Reals(count, 1)}, {long_name + "2", 3, Reals(3 * count)}};
  mesh.tet_data = {{std::string(300, 't') + "1", 1, Reals(mesh.tets.size(), 1)},
                   {std::string(300, 't') + "2", 1, Reals(mesh.tets.size(), 2)}};
  Group tips;
  tips.dimension = 0;
  tips.name = long_name;
  tips.number = 3;
  tips.members = {0};
  mesh.groups = {tips};
  write_mesh(folder / "a.e", mesh);
  const MeshData again = read_mesh(folder / "a.e");
  CHECK(again.point_data == mesh.point_data);
  CHECK(find_group(again, long_name) != nullptr);
  REQUIRE(again.tet_data.size() == 2);
  CHECK(again.tet_data[0].name == std::string(255, 't'));
  CHECK(again.tet_data[1].name == std::string(253, 't') + "_2");
  CHECK(again.tet_data[1].values == mesh.tet_data[1].values);
  const std::vector<std::string> lost = not_written(folder / "a.e", mesh);
  CHECK(std::count_if(lost.begin(), lost.end(), [](const std::string& note) {
          return note.find("is not kept as it is") != std::string::npos;
        }) == 2);
}

TEST_CASE("arrays of faces, which Exodus has no place for, are told, whatever the faces are") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  mesh.triangle_data = {{"of triangles", 1, Reals(mesh.triangles.size())}};
  mesh.edge_data = {{"of edges", 1, Reals(mesh.edges.size())}};
  mesh.other_elements = {{9, 4, {0, 1, 2, 3}, {4}, {}, {}, {{"of quads", 1, Reals{1}}}}};
  std::string lost;
  for (const std::string& note : not_written(folder / "a.e", mesh)) lost += note + '\n';
  CHECK(lost.find("'of triangles' of triangles is not kept") != std::string::npos);
  CHECK(lost.find("'of quads' of quadrilateral is not kept") != std::string::npos);
  CHECK(lost.find("of edges") == std::string::npos);
  write_mesh(folder / "a.e", mesh);
  CHECK(read_mesh(folder / "a.e").edge_data == mesh.edge_data);
}

TEST_CASE("a file of Exodus with any byte changed, or cut anywhere, is an error or a sound mesh") {
  const TempFolder folder;
  SmallExodus().write(folder / "a.e");
  change_each_byte(folder / "a.e", folder / "a.e");
  cut_at_each_byte(folder / "a.e");
}

TEST_CASE("a file that is none of netCDF is refused as Exodus") {
  const TempFolder folder;
  write_text(folder / "a.g", "ISO-10303-21;\n");
  CHECK(error_of_reading(folder / "a.g") == "a.g: the file is none of netCDF, as Exodus files are");
}
