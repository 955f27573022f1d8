// SPDX-License-Identifier: MIT
// MED files: families and groups, numbers, fields, second order, and tables that make no sense.
#include "kernel/formats/med.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <set>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/formats/hdf5_file.h"
#include "kernel/geometry.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Two tets and a triangle, as MED's own library writes them: family -6 is in two groups.
class SmallMed {
 public:
  SmallMed() {
    file_->set(made("INFOS_GENERALES"), "MAJ", 4);
    file_->set("INFOS_GENERALES", "MIN", 1);
    const std::string mesh = made("ENS_MAA/part");
    for (const char* what : {"ESP", "DIM"}) file_->set(mesh, what, 3);
    file_->set(mesh, "TYP", 0);
    file_->set(mesh, "DES", "a description");
    family("NOEUD/tip", 1, {"tip"});
    family("ELEME/FAM_-6", -6, {"left", "all"});
    family("ELEME/FAM_-7", -7, {"all"});
    family("ELEME/FAM_-8", -8, {"wall"});
  }

  std::string made(const std::string& path) {
    file_->group(path);
    return path;
  }
  void family(const std::string& name, int number, const std::vector<std::string>& groups) {
    const std::string path = made("FAS/part/" + name);
    file_->set(path, "NUM", number);
    file_->write_texts(path + "/GRO/NOM", groups, 80);
  }
  void field(const std::string& name, int components, std::vector<double> values) {
    const std::string path = made("CHA/" + name);
    file_->set(path, "MAI", "part");
    file_->set(path, "NCO", components);
    file_->set(path, "UNI", "Pa              ");
    file_->set(made(path + "/1"), "NDT", 3);
    file_->set(path + "/1", "NOR", 4);
    file_->set(path + "/1", "PDT", 0.1);
    file_->set(made(path + "/1/MAI.TE4"), "PFL", "MED_NO_PROFILE_INTERNAL");
    file_->set(made(path + "/1/MAI.TE4/MED_NO_PROFILE_INTERNAL"), "NGA", 1);
    file_->write(path + "/1/MAI.TE4/MED_NO_PROFILE_INTERNAL/CO", std::move(values));
  }
  void write(const std::filesystem::path& to) {
    file_->write("ENS_MAA/part/1/NOE/COO", coordinates);
    file_->write("ENS_MAA/part/1/NOE/FAM", node_families);
    file_->write("ENS_MAA/part/1/NOE/NUM", node_numbers);
    file_->write("ENS_MAA/part/1/MAI/TE4/NOD", tets);
    file_->write("ENS_MAA/part/1/MAI/TE4/FAM", tet_families);
    file_->write("ENS_MAA/part/1/MAI/TR3/NOD", std::vector<std::int32_t>{1, 2, 4});
    file_->write("ENS_MAA/part/1/MAI/TR3/FAM", std::vector<std::int32_t>{-8});
    write_text(to, file_->bytes());
    file_.reset();  // one at a time is open
  }

  std::vector<double> coordinates = {0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, -1};
  std::vector<std::int32_t> node_families = {0, 0, 0, 1, 0};
  std::vector<std::int64_t> node_numbers = {10, 20, 30, 40, 50};
  std::vector<std::int32_t> tets = {1, 1, 3, 2, 2, 3, 4, 5};
  std::vector<std::int32_t> tet_families = {-6, -7};

 private:
  std::unique_ptr<formats::Hdf5Writer> file_ = formats::make_hdf5("small.med", "MED");
};

}  // namespace

TEST_CASE(
    "a file of MED gives families as parts, groups, numbers, and tets turned as VTK has them") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  SmallMed small;
  small.field("SIGMA", 2, {1, 3, 2, 4});
  small.write(folder / "a.med");
  const MeshData mesh = read_mesh(folder / "a.med");
  CHECK(mesh.points.size() == 5);
  CHECK(mesh.point_numbers == std::vector<std::int64_t>{10, 20, 30, 40, 50});
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 6}, {{0, 2, 1, 4}, 7}});
  CHECK(mesh.tet_parts == std::vector<Label>{-6, -7});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 3}, 8}});
  REQUIRE(find_group(mesh, "all") != nullptr);
  CHECK(find_group(mesh, "all")->parts == std::vector<std::int32_t>{-6, -7});
  CHECK(find_group(mesh, "left")->parts == std::vector<std::int32_t>{-6});
  CHECK(find_group(mesh, "wall")->dimension == 2);
  CHECK(find_group(mesh, "tip")->members == std::vector<std::uint32_t>{3});
  REQUIRE(mesh.tet_data.size() == 1);
  CHECK(mesh.tet_data[0] == DataArray{"SIGMA", 2, std::vector<double>{1, 2, 3, 4}});
  CHECK(mesh.notes.empty());
}

TEST_CASE("what a file of MED holds survives writing, and writing again gives the same bytes") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  SmallMed small;
  small.field("SIGMA", 2, {1, 3, 2, 4});
  small.write(folder / "a.med");
  const MeshData mesh = read_mesh(folder / "a.med");
  CHECK(not_written(folder / "b.med", mesh).empty());
  write_mesh(folder / "b.med", mesh);
  const MeshData again = read_mesh(folder / "b.med");
  CHECK(again.tets == mesh.tets);
  CHECK(again.tet_parts == mesh.tet_parts);
  CHECK(again.groups.size() == mesh.groups.size());
  for (const Group& group : mesh.groups) {
    REQUIRE(find_group(again, group.name) != nullptr);
    CHECK(*find_group(again, group.name) == group);
  }
  CHECK(again.point_numbers == mesh.point_numbers);
  CHECK(again.tet_data == mesh.tet_data);
  const auto& deck = again.deck;
  for (const std::string& piece : mesh.deck) {
    CHECK(std::find(deck.begin(), deck.end(), piece) != deck.end());
  }
  write_mesh(folder / "c.med", again);
  CHECK(read_text(folder / "b.med") == read_text(folder / "c.med"));
  const std::vector<std::string> lost = not_written(folder / "b.msh", mesh);
  REQUIRE(lost.size() == 1);  // description, unit and time
  CHECK(lost[0].starts_with("3 pieces of a deck"));
}

TEST_CASE("tets that another writer lists as VTK has them stay so, and families without groups") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  SmallMed small;
  small.tets = {1, 1, 2, 3, 3, 2, 4, 5};
  small.tet_families = {-3, -4};
  small.write(folder / "a.med");
  const MeshData mesh = read_mesh(folder / "a.med");
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 3}, {{0, 2, 1, 4}, 4}});
  REQUIRE(mesh.notes.size() == 1);
  CHECK(mesh.notes[0] == "2 groups without elements are not kept, the first is 'all'");
  write_mesh(folder / "b.med", mesh);
  CHECK(read_mesh(folder / "b.med").tets == mesh.tets);
  CHECK(read_mesh(folder / "b.med").groups == mesh.groups);
}

TEST_CASE("labels without groups become groups of MED, which are labels when they are read again") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1), Point(0, 0, -1)};
  mesh.tets = {{{0, 1, 2, 3}, -2}, {{0, 2, 1, 4}, 0}};
  mesh.triangles = {{{0, 1, 2}, 7}};
  mesh.point_labels = {0, 3, 0, 0, 0};
  mesh.groups = {{2, 7, std::string(90, 'x'), {}, {}}, {3, 9, "first", {}, {0}}};
  write_mesh(folder / "a.med", mesh);
  const MeshData again = read_mesh(folder / "a.med");
  CHECK(again.tets == mesh.tets);
  CHECK(again.point_labels == mesh.point_labels);
  REQUIRE(find_group(again, "first") != nullptr);
  CHECK(find_group(again, "first")->parts.size() == 1);
  REQUIRE(find_group(again, std::string(80, 'x')) != nullptr);
  const std::vector<std::string> lost = not_written(folder / "a.med", mesh);
  REQUIRE(lost.size() == 1);
  CHECK(lost[0].starts_with("names of groups are not kept as they are"));
}

TEST_CASE("fields of MED have 64 bytes of name at most, groups 80, and all of them are different") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  mesh.tets = {{{0, 1, 2, 3}, 1}};
  const std::string name(70, 'f');
  mesh.point_data = {{name + "1", 1, std::vector<double>{1, 2, 3, 4}},
                     {name + "2", 2, std::vector<double>(8, 5)}};
  const std::string cut(80, 'g');
  mesh.groups = {{3, 1, cut, {}, {0}}, {3, 2, cut + "a", {}, {0}}, {3, 3, cut + "b", {}, {0}}};
  write_mesh(folder / "a.med", mesh);
  const MeshData again = read_mesh(folder / "a.med");
  REQUIRE(again.point_data.size() == 2);
  CHECK(again.point_data[1].name == std::string(64, 'f'));
  CHECK(again.point_data[0].name == std::string(62, 'f') + "_2");
  for (const std::string& group : {cut, std::string(78, 'g') + "_2", std::string(78, 'g') + "_3"})
    CHECK(find_group(again, group) != nullptr);
}

TEST_CASE("two groups of MED with one name and dimension stay two, and a note says so") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1), Point(0, 0, -1)};
  mesh.tets = {{{0, 1, 2, 3}, 0}, {{0, 2, 1, 4}, 0}};
  mesh.triangles = {{{0, 1, 3}, 0}};
  mesh.groups = {{3, 1, "wall", {}, {0}}, {3, 2, "wall", {}, {0, 1}}, {2, 3, "wall", {}, {0}}};
  const std::vector<std::string> lost = not_written(folder / "a.med", mesh);
  CHECK(lost ==
        std::vector<std::string>{"1 names of groups get a number: .med has each name once"});
  write_mesh(folder / "a.med", mesh);
  const MeshData again = read_mesh(folder / "a.med");
  std::multiset<std::string> names;
  for (const Group& group : again.groups)
    names.insert(fmt::format("{} {}: {}", group.dimension, group.name, group.parts.size()));
  CHECK(names == std::multiset<std::string>{"2 wall: 1", "3 wall: 1", "3 wall_2: 2"});
}

TEST_CASE("tables of MED that make no sense are refused with the table and the reason") {
  if (!formats::has_hdf5()) return;
  struct Case {
    std::function<void(SmallMed&)> spoil;
    std::string table, reason;
  };
  const std::vector<Case> cases = {
      {[](SmallMed& m) { m.tets[7] = 6; }, "TE4/NOD'", "'6' in element 2 is not the number"},
      {[](SmallMed& m) { m.tets[0] = 0; }, "TE4/NOD'", "'0' in element 1 is not the number"},
      {[](SmallMed& m) { m.tets.pop_back(); }, "TE4/NOD'", "7 numbers are not 4 for each element"},
      {[](SmallMed& m) { m.tet_families = {-6}; }, "TE4/FAM'", "has 1 values: expected 2"},
      {[](SmallMed& m) { m.node_numbers.resize(9); }, "NOE/NUM'", "has 9 values: expected 5"},
      {[](SmallMed& m) { m.coordinates.pop_back(); }, "NOE/COO'", "not three for each point"},
      {[](SmallMed& m) { m.coordinates[7] = std::nan(""); }, "NOE/COO'",
       "of point 3 is not finite"},
      {[](SmallMed& m) {
         m.field("f", 2, {1, 2, 3});
       },
       "/CO'", "has 3 values: expected 2 for each"},
      {[](SmallMed& m) { m.field("f", -1, {1}); }, "/CHA/f'", "components makes no sense"},
      {[](SmallMed& m) { m.made("ENS_MAA/other"); }, "/ENS_MAA'", "has 2 meshes: expected one"},
      {[](SmallMed& m) { m.made("ENS_MAA/part/1/MAI/POE"); }, "MAI/POE'", "cannot be kept"}};
  for (const Case& bad : cases) {
    CAPTURE(bad.reason);
    const TempFolder folder;
    SmallMed small;
    bad.spoil(small);
    small.write(folder / "a.med");
    const std::string error = error_of_reading(folder / "a.med");
    CHECK(error.starts_with("a.med: '/"));
    CHECK(error.find(bad.table) != std::string::npos);
    CHECK(error.find(bad.reason) != std::string::npos);
  }
}

TEST_CASE("a file that is none of HDF5 is refused as MED") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  write_text(folder / "a.med", "MeshVersionFormatted 2\n");
  CHECK(error_of_reading(folder / "a.med")
            .starts_with("a.med: the file cannot be read as one of HDF5"));
}
