// SPDX-License-Identifier: MIT
// CGNS files: sections, boundary conditions, solutions, mixed sections, and trees that make no sense.
#include "kernel/formats/cgns.h"

#include <algorithm>
#include <functional>
#include <memory>

#include <doctest/doctest.h>

#include "contract/zoo.h"
#include "kernel/formats/hdf5_file.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Two tets and a triangle in a mixed section, a wall by range, a point by list, a velocity.
class SmallCgns {
 public:
  SmallCgns() {
    node("Base", "CGNSBase_t", Integers{3, 3});
    node("Base/Zone", "Zone_t", Integers{5, 2, 0});
    text("Base/Zone/ZoneType", "ZoneType_t", "Unstructured");
    text("Base/wall", "Family_t", "");
    text("Base/wall/FamilyBC", "FamilyBC_t", "BCWall");
    text("Base/Zone/ZoneBC", "ZoneBC_t", "");
    text("Base/Zone/ZoneBC/skin", "BC_t", "FamilySpecified");
    text("Base/Zone/ZoneBC/skin/FamilyName", "FamilyName_t", "wall");
    text("Base/Zone/ZoneBC/skin/GridLocation", "GridLocation_t", "FaceCenter");
    text("Base/Zone/ZoneBC/tip", "BC_t", "BCTypeNull");
  }
  void node(const std::string& path, const std::string& label, const DataArray::Values& values) {
    file_->group(path);
    file_->set(path, "label", label);
    file_->write(path + "/ data", values);
  }
  void text(const std::string& path, const std::string& label, const std::string& characters) {
    file_->group(path);
    file_->set(path, "label", label);
    if (!characters.empty()) file_->write_characters(path + "/ data", characters);
  }
  void write(const std::filesystem::path& to) {
    text("Base/Zone/GridCoordinates", "GridCoordinates_t", "");
    node("Base/Zone/GridCoordinates/CoordinateX", "DataArray_t", x);
    node("Base/Zone/GridCoordinates/CoordinateY", "DataArray_t", Reals{0, 0, 1, 0, 0});
    node("Base/Zone/GridCoordinates/CoordinateZ", "DataArray_t", Reals{0, 0, 0, 1, -1});
    node("Base/Zone/Upper", "Elements_t", Integers{10, 0});
    node("Base/Zone/Upper/ElementRange", "IndexRange_t", Integers{1, 1});
    node("Base/Zone/Upper/ElementConnectivity", "DataArray_t", upper);
    node("Base/Zone/Lower", "Elements_t", Integers{20, 0});
    node("Base/Zone/Lower/ElementRange", "IndexRange_t", lower_range);
    node("Base/Zone/Lower/ElementConnectivity", "DataArray_t", lower);
    node("Base/Zone/ZoneBC/skin/PointRange", "IndexRange_t", skin);
    node("Base/Zone/ZoneBC/tip/PointList", "IndexArray_t", Integers{4});
    text("Base/Zone/Solution", "FlowSolution_t", "");
    for (const char* axis : {"X", "Y", "Z"}) {
      node(std::string("Base/Zone/Solution/Velocity") + axis, "DataArray_t", Reals(5, *axis - 'X'));
    }
    write_text(to, file_->bytes());
    file_.reset();  // one at a time is open
  }

  Reals x = {0, 1, 0, 0, 0};
  Integers upper = {1, 2, 3, 4}, lower = {10, 1, 3, 2, 5, 5, 1, 2, 4}, lower_range = {2, 3};
  Integers skin = {3, 3};

 private:
  std::unique_ptr<formats::Hdf5Writer> file_ = formats::make_hdf5("small.cgns", "CGNS");
};

}  // namespace

TEST_CASE("a CGNS file gives sections of volumes as labels, conditions as groups, vectors whole") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  SmallCgns().write(folder / "a.cgns");
  const MeshData mesh = read_mesh(folder / "a.cgns");
  CHECK(mesh.points.size() == 5);
  REQUIRE(mesh.tets.size() == 2);
  CHECK(mesh.tets[0].vertices == std::array<std::uint32_t, 4>{0, 1, 2, 3});
  CHECK(mesh.tets[0].label != mesh.tets[1].label);
  REQUIRE(mesh.triangles.size() == 1);
  CHECK(mesh.triangles[0].vertices == std::array<std::uint32_t, 3>{0, 1, 3});
  REQUIRE(find_group(mesh, "skin") != nullptr);
  CHECK(find_group(mesh, "skin")->dimension == 2);
  REQUIRE(find_group(mesh, "tip") != nullptr);
  CHECK(find_group(mesh, "tip")->members == std::vector<std::uint32_t>{3});
  REQUIRE(find_group(mesh, "Upper") != nullptr);
  REQUIRE(mesh.point_data.size() == 1);
  CHECK(mesh.point_data[0].name == "Velocity");
  CHECK(mesh.point_data[0].components == 3);
}

TEST_CASE("what a CGNS file holds survives writing, and writing again gives the same bytes") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  SmallCgns().write(folder / "a.cgns");
  const MeshData mesh = read_mesh(folder / "a.cgns");
  CHECK(not_written(folder / "b.cgns", mesh).empty());
  write_mesh(folder / "b.cgns", mesh);
  const MeshData again = read_mesh(folder / "b.cgns");
  CHECK(again.tets == mesh.tets);
  CHECK(again.triangles == mesh.triangles);
  CHECK(again.point_data == mesh.point_data);
  CHECK(again.groups == mesh.groups);
  CHECK(again.deck == mesh.deck);
  write_mesh(folder / "c.cgns", again);
  CHECK(read_text(folder / "b.cgns") == read_text(folder / "c.cgns"));
}

TEST_CASE("labels of named sections of CGNS stay whichever tet comes first") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  MeshData mesh = contract::kuhn_cube(1, 0, 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.tets[t].label = t == 0 ? 2 : 1;
  mesh.groups = {{3, 1, "one", {}, {}}, {3, 2, "two", {}, {}}};
  for (const char* name : {"a.cgns", "a.feb"}) {
    write_mesh(folder / name, mesh);
    const MeshData again = read_mesh(folder / name);
    const auto is_two = [](const MeshData::Tet& tet) { return tet.label == 2; };
    CHECK(std::count_if(again.tets.begin(), again.tets.end(), is_two) == 1);
  }
}

TEST_CASE("tets, hexahedra and prisms of one label are one mixed section of CGNS") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  MeshData mesh;
  for (int i = 0; i < 12; ++i) mesh.points.emplace_back(i % 2, i / 2 % 2, i / 4);
  mesh.points.emplace_back(5, 5, 5);
  mesh.tets = {{{0, 1, 2, 12}, 4}};
  mesh.tet_data = {{"T", 1, Integers{1}}};
  mesh.other_elements = {{12, 8, {0, 1, 3, 2, 4, 5, 7, 6}, {4}, {}, {}, {{"T", 1, Integers{2}}}}};
  write_mesh(folder / "a.cgns", mesh);
  const MeshData again = read_mesh(folder / "a.cgns");
  CHECK(again.tets == mesh.tets);
  REQUIRE(again.other_elements.size() == 1);
  CHECK(again.other_elements[0].labels == std::vector<Label>{4});
  CHECK(again.other_elements[0].vertices == mesh.other_elements[0].vertices);
  CHECK(again.other_elements[0].data == mesh.other_elements[0].data);
  CHECK(again.tet_data == mesh.tet_data);
}

TEST_CASE("trees of CGNS that make no sense are refused with the node and the reason") {
  if (!formats::has_hdf5()) return;
  struct Case {
    std::function<void(SmallCgns&)> spoil;
    std::string reason;
  };
  const std::vector<Case> cases = {
      {[](SmallCgns& m) { m.upper[3] = 6; }, "'6' in element 1 is not the number of a node"},
      {[](SmallCgns& m) { m.upper.pop_back(); }, "the table ends too early"},
      {[](SmallCgns& m) { m.lower[0] = 23; }, "elements of CGNS' type 23 cannot be kept"},
      {[](SmallCgns& m) { m.lower.push_back(10); }, "the table is longer than its elements"},
      {[](SmallCgns& m) {
         m.lower_range = {1, 2};
       },
       "overlaps that of another section"},
      {[](SmallCgns& m) {
         m.lower_range = {3, 2};
       },
       "the section has no range of elements"},
      {[](SmallCgns& m) {
         m.skin = {3, 9};
       },
       "'4' is not the number of an element"},
      {[](SmallCgns& m) { m.x.pop_back(); }, "the table has 5 values: expected 4"},
      {[](SmallCgns& m) {
         m.node("Base/Other", "Zone_t", Integers{1, 1, 0});
       },
       "the file has 2 zones: expected one"}};
  for (const Case& bad : cases) {
    CAPTURE(bad.reason);
    const TempFolder folder;
    SmallCgns small;
    bad.spoil(small);
    small.write(folder / "a.cgns");
    const std::string error = error_of_reading(folder / "a.cgns");
    CHECK(error.starts_with("a.cgns: '/"));
    CHECK(error.find(bad.reason) != std::string::npos);
  }
}

TEST_CASE(
    "a file of HDF5 without a node that is labelled a zone is no CGNS, and the reason says so") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  write_mesh(folder / "a.med", awkward_mesh());
  std::filesystem::rename(folder / "a.med", folder / "a.cgns");
  CHECK(
      error_of_reading(folder / "a.cgns").starts_with("a.cgns: '/': no node of the file has the "));
}

TEST_CASE("groups that are called like nodes of a zone are written to CGNS under other names") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{{0, 1, 2, 3}, 3}};
  for (const char* name : {"ZoneBC", "GridCoordinates"}) {
    Group group;
    group.dimension = 3;
    group.name = name;
    group.number = 3;
    group.members = {0};
    mesh.groups = {group};
    write_mesh(folder / "a.cgns", mesh);
    CHECK(read_mesh(folder / "a.cgns").tets.size() == 1);
  }
}

TEST_CASE("arrays whose names CGNS has no place for get others that fit, vectors stay whole") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{{0, 1, 2, 3}, 3}};
  const std::string name(32, 'a');
  mesh.point_data = {{"GridLocation", 1, Reals{1, 2, 3, 4}},
                     {name + "b", 1, Reals{5, 6, 7, 8}},
                     {name, 3, Reals(12, 9)},
                     {"good", 1, Reals(4)}};
  const std::vector<std::string> lost = not_written(folder / "a.cgns", mesh);
  CHECK(lost.size() == 3);
  write_mesh(folder / "a.cgns", mesh);
  const MeshData again = read_mesh(folder / "a.cgns");
  const auto values = [&](std::string_view of) {
    const auto found = std::find_if(again.point_data.begin(), again.point_data.end(),
                                    [&](const DataArray& array) { return array.name == of; });
    return found == again.point_data.end() ? DataArray::Values() : found->values;
  };
  CHECK(again.point_data.size() == 4);
  CHECK(values("GridLocation_2") == mesh.point_data[0].values);
  CHECK(values(name) == mesh.point_data[1].values);
  CHECK(values(name.substr(1)) == mesh.point_data[2].values);
}

TEST_CASE("what of a tree of CGNS is not kept is told, each kind of node once") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  SmallCgns small;
  small.node("Base/Zone/Upper/ParentElements", "DataArray_t", Integers{0, 0});  // said by elements
  for (const char* section : {"Upper", "Lower"}) {
    small.node(std::string("Base/Zone/") + section + "/notes", "UserDefinedData_t", Integers{1});
    small.node(std::string("Base/Zone/") + section + "/notes/more", "DataArray_t", Integers{1});
  }
  small.node("Base/Zone/ZoneBC/skin/BCDataSet", "BCDataSet_t", Integers{1});
  small.node("Base/Units", "DimensionalUnits_t", Integers{1});
  small.write(folder / "a.cgns");
  const std::vector<std::string> wanted = {
      "the node '/Base/Zone/ZoneBC/skin/BCDataSet' is not kept",
      "the node '/Base/Units' is not kept",
      "2 nodes of type 'UserDefinedData_t' are not kept, the first is '/Base/Zone/Lower/notes'"};
  CHECK(read_mesh(folder / "a.cgns").notes == wanted);
}

TEST_CASE(
    "a section of polygons is told with what conditions lose, and the family of a zone stays") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  SmallCgns small;
  small.node("Base/Zone/Polygons", "Elements_t", Integers{22, 0});
  small.node("Base/Zone/Polygons/ElementRange", "IndexRange_t", Integers{4, 4});
  small.node("Base/Zone/Polygons/ElementConnectivity", "DataArray_t", Integers{1, 2, 3});
  small.text("Base/Zone/FamilyName", "FamilyName_t", "fluid");
  small.skin = {3, 4};
  small.write(folder / "a.cgns");
  const MeshData mesh = read_mesh(folder / "a.cgns");
  const std::vector<std::string> wanted = {
      "the section 'Polygons' is not kept: 1 elements of CGNS' type 22",
      "1 of 2 members of the boundary condition 'skin' are not kept: they are in no mesh"};
  CHECK(mesh.notes == wanted);
  write_mesh(folder / "b.cgns", mesh);
  CHECK(read_mesh(folder / "b.cgns").deck == mesh.deck);
}

TEST_CASE("an older CGNS file of ADF is refused with the program that makes HDF5 of it") {
  const TempFolder folder;
  write_text(folder / "a.cgns", "@(#)ADF Database Version A02011>");
  CHECK(error_of_reading(folder / "a.cgns").find("adf2hdf") != std::string::npos);
}
