// SPDX-License-Identifier: MIT
// Legacy VTK files of several versions, made by hand, and how bad ones are refused.
#include <cmath>

#include <doctest/doctest.h>

#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const std::string kHead = "# vtk DataFile Version 2.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n";
const std::string kVtkPoints = "POINTS 4 double\n0 0 0 1 0 0\n0 1 0 0 0 1\n";
const std::string kCells = "CELLS 2 9\n4 0 1 2 3\n3 0 1 2\nCELL_TYPES 2\n10\n5\n";
const std::string kHead5 = "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n";
const std::string kCells5 =
    "CELLS 3 7\nOFFSETS vtktypeint64\n0 4 7\nCONNECTIVITY vtktypeint64\n0 1 2 3 0 1 2\nCELL_TYPES "
    "2\n10\n5\n";

std::vector<Label> labels_of(const std::string& data) {
  const MeshData mesh = read_as("a.vtk", kHead + kVtkPoints + kCells + data);
  REQUIRE(mesh.tets.size() == 1);
  REQUIRE(mesh.triangles.size() == 1);
  return {mesh.tets[0].label, mesh.triangles[0].label};
}

}  // namespace

TEST_CASE("arrays of every kind are read from an ASCII VTK file and labels are found among them") {
  const std::string data =
      "CELL_DATA 2\n"
      "SCALARS quality float 1\nLOOKUP_TABLE my_table\n0.5 nan\nLOOKUP_TABLE my_table 2\n0 0 0 "
      "1\n1 1 1 1\n"
      "METADATA\nINFORMATION 1\nNAME a LOCATION b\nDATA 1\n\n"
      "COLOR_SCALARS c 3\n0 0 0 1 1 1\nVECTORS v float\n1 2 3 4 5 6\nNORMALS n double\n1 0 0 0 1 "
      "0\n"
      "TENSORS t float\n1 0 0 0 1 0 0 0 1\n1 0 0 0 1 0 0 0 1\nTENSORS6 t6 float\n1 0 0 0 1 0\n1 0 "
      "0 0 1 0\n"
      "TEXTURE_COORDINATES tc 2 float\n0 0 1 1\nGLOBAL_IDS g vtkIdType\n4 5\n"
      "FIELD FieldData 4\nnames 1 2 string\nan%20a\nb\nMETADATA\nCOMPONENT_NAMES\nx\n\nbits 1 2 "
      "bit\n0 1\n"
      "medit:ref 1 2 vtktypeint64\n-3 4\npairs 2 2 unsigned_char\n1 2 3 4\n"
      "POINT_DATA 4\nscalars CellEntityIds int\nlookup_table default\n1 0 0 9\n";
  CHECK(labels_of(data) == std::vector<Label>{-3, 4});
  const MeshData mesh = read_as("a.vtk", kHead + kVtkPoints + kCells + data);
  CHECK(mesh.point_labels == std::vector<Label>{1, 0, 0, 9});
  CHECK(mesh.label_array == "medit:ref");
  std::vector<std::string> names;
  for (const DataArray& array : mesh.tet_data) {
    names.push_back(array.name + "*" + std::to_string(array.components));
  }
  CHECK(names == std::vector<std::string>{"quality*1", "v*3", "n*3", "t*9", "t6*6", "tc*2", "g*1",
                                          "pairs*2"});
  CHECK(std::get<std::vector<float>>(mesh.tet_data[1].values) == std::vector<float>{1, 2, 3});
  CHECK(std::get<std::vector<float>>(mesh.triangle_data[1].values) == std::vector<float>{4, 5, 6});
  CHECK(std::isnan(std::get<std::vector<float>>(mesh.triangle_data[0].values)[0]));
  CHECK(std::get<std::vector<std::int32_t>>(mesh.tet_data[7].values) ==
        std::vector<std::int32_t>{1, 2});
  CHECK(mesh.notes ==
        std::vector<std::string>{"the array 'my_table' is not kept", "the array 'c' is not kept",
                                 "the array 'names' is not kept: it holds no numbers",
                                 "the array 'bits' is not kept: it holds no numbers"});
}

TEST_CASE(
    "the best known name gives the labels of a VTK file, in any case and type, but no fractions") {
  const std::string begin = "CELL_DATA 2\n";
  const auto scalars = [](const std::string& name, const std::string& type,
                          const std::string& values) {
    return "SCALARS " + name + " " + type + "\nLOOKUP_TABLE default\n" + values + "\n";
  };
  CHECK(labels_of(begin + scalars("Material", "double", "3.0 -1e3")) ==
        std::vector<Label>{3, -1000});
  CHECK(labels_of(begin + scalars("region", "int", "1 2") +
                  scalars("CellEntityIds", "int", "3 4")) == std::vector<Label>{3, 4});
  CHECK(labels_of(begin + scalars("LABEL", "short", "3 4") + scalars("region", "int", "1 2")) ==
        std::vector<Label>{3, 4});
  CHECK(labels_of(begin + scalars("material", "float", "0.5 1")) == std::vector<Label>{0, 0});
  CHECK(labels_of(begin + scalars("mat_id", "int", "7 8") + scalars("x", "int", "1 2")) ==
        std::vector<Label>{7, 8});
  CHECK(labels_of(begin + scalars("other", "int", "1 2")) == std::vector<Label>{1, 2});
  CHECK(labels_of(begin + scalars("a", "int", "1 2") + scalars("b", "int", "3 4")) ==
        std::vector<Label>{0, 0});
  CHECK(labels_of(begin + "SCALARS label int 1\n5 6\n") == std::vector<Label>{5, 6});
  CHECK(labels_of(begin + "SCALARS label int 2\nLOOKUP_TABLE default\n5 6 7 8\n") ==
        std::vector<Label>{0, 0});
}

TEST_CASE("the array of labels can be named") {
  const TempFolder folder;
  const std::string data =
      "CELL_DATA 2\nSCALARS region int\nLOOKUP_TABLE default\n1 2\n"
      "SCALARS group float\nLOOKUP_TABLE default\n3 4\n"
      "SCALARS density float\nLOOKUP_TABLE default\n0.5 4\n";
  write_text(folder / "a.vtk", kHead + kVtkPoints + kCells + data);
  const MeshData mesh = read_mesh(folder / "a.vtk", "group");
  CHECK(mesh.tets[0].label == 3);
  CHECK(mesh.label_array == "group");
  CHECK(mesh.tet_data[0].name == "region");
  const auto error = [&](const std::string& name) {
    try {
      read_mesh(folder / "a.vtk", name);
    } catch (const Error& failure) {
      return std::string(failure.what()).substr((folder / "").string().size());
    }
    return std::string("no error");
  };
  CHECK(error("density") == "a.vtk:23: 0.5 is no label: expected an integer");
  CHECK(error("nothing").find("there is region, group, density") != std::string::npos);
  write_mesh(folder / "a.mesh", mesh);
  CHECK_THROWS_AS(read_mesh(folder / "a.mesh", "group"), Error);
}

TEST_CASE("a VTK file keeps arrays, their names and cells of other kinds when it is written") {
  const TempFolder folder;
  const std::string text =
      kHead + kVtkPoints +
      "CELLS 4 18\n4 0 1 2 3\n3 0 1 2\n4 0 1 2 3\n3 1 2 3\nCELL_TYPES 4\n9\n5\n10\n5\n"
      "CELL_DATA 4\nSCALARS mat_id int\nLOOKUP_TABLE default\n5 6 7 8\n"
      "FIELD FieldData 3\nwith%20blank%01 2 4 double\n1 2 3 4 5 6 7 8\nids 1 4 vtktypeint64\n1 2 3 "
      "4000000000\nx 1 4 float\n1 2 3 nan\n"
      "POINT_DATA 4\nVECTORS u double\n1 2 3 4 5 6 7 8 9 10 11 12\n";
  write_text(folder / "a.vtk", text);
  const MeshData first = read_mesh(folder / "a.vtk");
  CHECK(first.notes.empty());
  CHECK(first.tets[0].label == 7);
  CHECK(first.tet_data[0].name == "with blank\x01");
  CHECK(first.tet_data[0].values == DataArray::Values(std::vector<double>{5, 6}));
  REQUIRE(first.other_elements.size() == 1);
  CHECK(first.other_elements[0].vtk_type == 9);
  CHECK(first.other_elements[0].labels == std::vector<Label>{5});
  write_mesh(folder / "b.vtk", first);
  const MeshData second = read_mesh(folder / "b.vtk");
  CHECK(second.label_array == "mat_id");
  CHECK(second.tets == first.tets);
  CHECK(second.triangles == first.triangles);
  CHECK(second.other_elements == first.other_elements);
  CHECK(second.tet_data == first.tet_data);
  CHECK(second.point_data == first.point_data);
  write_mesh(folder / "c.vtk", second);
  CHECK(read_text(folder / "c.vtk") == read_text(folder / "b.vtk"));
  CHECK(not_written(folder / "c.vtk", second).empty());
  CHECK(not_written(folder / "c.mesh", second).size() == 7);
}

TEST_CASE("an ASCII VTK file stays one, bit for bit, and the other form can be asked for") {
  const TempFolder folder;
  const std::string text = kHead + kVtkPoints + kCells +
                           "CELL_DATA 2\nSCALARS mat_id int\nLOOKUP_TABLE default\n5 6\n"
                           "FIELD FieldData 4\nids 1 2 long\n7 4000000000\nx 1 2 float\n0.1 nan\n"
                           "y 2 2 double\n0.1 1e-300 -0 3\nn 1 2 int\n-7 8\n"
                           "POINT_DATA 4\nVECTORS u double\n1 2 3 4 5 6 7 8 9 10 11 12\n";
  write_text(folder / "a.vtk", text);
  const MeshData first = read_mesh(folder / "a.vtk");
  for (const std::string_view variant : {"", "ASCII", "binary"}) {
    CAPTURE(variant);
    MeshView view(first);
    view.set_variant(variant);
    write_mesh(folder / "b.vtk", view);
    const std::string written = read_text(folder / "b.vtk");
    CHECK(written.find(variant == "binary" ? "\nBINARY\n" : "\nASCII\n") != std::string::npos);
    CHECK(written.find("vtktypeint64") == std::string::npos);  // none of version 3.0
    const MeshData second = read_mesh(folder / "b.vtk");
    CHECK(second.points == first.points);
    CHECK(second.tets == first.tets);
    CHECK(second.triangles == first.triangles);
    REQUIRE(second.tet_data.size() == first.tet_data.size());
    for (std::size_t i = 0; i < first.tet_data.size(); ++i) {
      CHECK(second.tet_data[i].values.index() == first.tet_data[i].values.index());
      CHECK(second.tet_data[i].name == first.tet_data[i].name);
    }
    CHECK(second.tet_data[0] == first.tet_data[0]);
    CHECK(second.tet_data[2] == first.tet_data[2]);
    CHECK(second.point_data == first.point_data);
  }
  MeshData other = awkward_mesh();
  other.variant = "2.2 ASCII";  // of Gmsh
  write_mesh(folder / "c.vtk", other);
  CHECK(read_text(folder / "c.vtk").find("\nBINARY\n") != std::string::npos);
}

TEST_CASE("what VTK takes an array for survives, from each of its formats to the other") {
  const TempFolder folder;
  const std::string text = kHead + kVtkPoints + kCells +
                           "CELL_DATA 2\nGLOBAL_IDS cells vtkIdType\n40 50\n"
                           "POINT_DATA 4\nPEDIGREE_IDS p%20q vtkIdType\n4 5 6 7\n"
                           "NORMALS n double\n1 0 0 1 0 0 1 0 0 1 0 0\n";
  write_text(folder / "a.vtk", text);
  for (const char* file : {"b.vtu", "b.vtk"}) {
    CAPTURE(file);
    write_mesh(folder / file, read_mesh(folder / "a.vtk"));
    const std::string through = read_text(folder / file);
    CHECK(not_written(folder / file, read_mesh(folder / "a.vtk")).empty());
    write_mesh(folder / "c.vtk", read_mesh(folder / file));
    const std::string written = read_text(folder / "c.vtk");
    CHECK(written.find("\nGLOBAL_IDS cells vtkIdType\n40 \n50 \n") != std::string::npos);
    CHECK(written.find("\nPEDIGREE_IDS p%20q vtkIdType\n") != std::string::npos);
    CHECK(written.find("\nNORMALS n double\n1 0 0 \n") != std::string::npos);
  }
  const std::string xml = read_text(folder / "b.vtu");
  CHECK(xml.find("<CellData GlobalIds=\"cells\">") != std::string::npos);
  CHECK(xml.find("<PointData PedigreeIds=\"p q\" Normals=\"n\">") != std::string::npos);
  // Numbers that VTK's vtkIdType of 4 bytes does not hold are an array like any other.
  std::string wide = text;
  wide.replace(wide.find("4 5 6 7"), 7, "4 5 6 7000000000");
  write_text(folder / "a.vtk", wide);
  write_mesh(folder / "c.vtk", read_mesh(folder / "a.vtk"));
  CHECK(read_text(folder / "c.vtk").find("p%20q 1 4 long\n") != std::string::npos);
  // They are none of the mesh: other formats lose no more than the arrays.
  CHECK(not_written(folder / "c.mesh", read_mesh(folder / "c.vtk")).size() == 4);
}

TEST_CASE("points, lines and polygons of a VTK file are kept by their type") {
  const MeshData mesh = read_as(
      "a.vtk", kHead + kVtkPoints +
                   "CELLS 5 18\n1 3\n4 0 1 2 3\n4 0 1 2 3\n2 1 3\n2 0 1\nCELL_TYPES 5\n1 9 10 3 4\n"
                   "CELL_DATA 5\nSCALARS label int\nLOOKUP_TABLE default\n1 2 3 4 5\n");
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 3}});
  CHECK(mesh.edges == std::vector<MeshData::Edge>{{{1, 3}, 4}});
  CHECK(mesh.triangles.empty());
  CHECK(mesh.other_elements.size() == 3);
}

TEST_CASE("a VTK file of version 5.1 is read in ASCII") {
  const MeshData mesh =
      read_as("a.vtk", kHead5 + kVtkPoints + "METADATA\nINFORMATION 0\n\n" + kCells5);
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 0}});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, 0}});
}

TEST_CASE("a VTK file of version 5.1 is read in binary") {
  Bytes file(std::endian::big);
  file.text(
      "# vtk DataFile Version 5.1\nvtk output\nBINARY\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData "
      "2\n");
  file.text("words 1 2 string\n")
      .text("\xC3")
      .text("abc")
      .text("\x80")
      .text("\x01")
      .text("z")
      .text("\n");
  file.text("TimeValue 1 1 double\n").add(0.5).text("\nPOINTS 4 float\n");
  file.add_all<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25f, 0, 1});
  file.text("\nMETADATA\nINFORMATION 0\n\nCELLS 3 7\nOFFSETS vtktypeint64\n");
  file.add_all<std::int64_t>({0, 4, 7}).text("\nCONNECTIVITY vtktypeint64\n");
  file.add_all<std::int64_t>({0, 1, 2, 3, 0, 1, 2}).text("\nCELL_TYPES 2\n");
  file.add_all<std::int32_t>({10, 5})
      .text("\nCELL_DATA 2\nFIELD FieldData 4\nbits 1 2 bit\n")
      .text("\x40\n");
  file.text("label 1 2 unsigned_char\n").text("\x01\xff\n").text("empty 1 0 double\n\n");
  file.text("pair 2 2 vtkIdType\n").add_all<std::int32_t>({1, 2, 3, 4}).text("\nPOINT_DATA 4\n");
  file.text("COLOR_SCALARS c 2\n")
      .text("12345678\n")
      .text("SCALARS CellEntityIds vtktypeint64\nLOOKUP_TABLE t\n");
  file.add_all<std::int64_t>({0, -1, INT32_MAX, INT32_MIN})
      .text("\nLOOKUP_TABLE t 2\n")
      .text("12341234\n");
  const MeshData mesh = read_as("a.vtk", file.str());
  CHECK(mesh.points[3] == Point(0.25, 0, 1));
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 1}});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, 255}});
  CHECK(mesh.point_labels == std::vector<Label>{0, -1, INT32_MAX, INT32_MIN});
}

TEST_CASE("a VTK file is written in the layout of version 4.2 that old readers take") {
  const TempFolder folder;
  write_mesh(folder / "a.vtk", awkward_mesh());
  const std::string content = read_text(folder / "a.vtk");
  CHECK(content.starts_with("# vtk DataFile Version 3.0\n"));
  CHECK(content.find("OFFSETS") == std::string::npos);
  CHECK(content.find("\nSCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n") != std::string::npos);
}

TEST_CASE("a bad VTK file is refused with line or byte, word and reason") {
  const std::string binary =
      "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n";
  const std::string cell_data = "CELL_DATA 2\n";
  const auto replaced = [](std::string text, std::string_view from, std::string_view to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
  };
  const std::string good = kHead + kVtkPoints + kCells;
  const std::string good5 = kHead5 + kVtkPoints + kCells5;
  const std::vector<BadFile> files = {
      {"text", "hello\n", ":1: ", "'hello' is not the beginning of a legacy VTK file"},
      {"XML", "<?xml version=\"1.0\"?>\n<VTKFile>\n",
       ":1: ", "is not the beginning of a legacy VTK file"},
      {"version 6", replaced(good, "2.0", "6.0"), ":1: ", "is unknown: expected 1.0 to 5.1"},
      {"neither", replaced(good, "ASCII", "UTF-8"),
       ":3: ", "'UTF-8' is not expected here: expected ASCII or BINARY"},
      {"polydata", replaced(good, "UNSTRUCTURED_GRID", "POLYDATA"),
       ":4: ", "the data set 'POLYDATA' cannot be read"},
      {"no points", kHead + "CELLS 0 0\nCELL_TYPES 0\n", ":7: ", "the section POINTS is missing"},
      {"no cells", kHead + kVtkPoints, ":8: ", "the section CELLS is missing"},
      {"no types", kHead + kVtkPoints + "CELLS 1 5\n4 0 1 2 3\n",
       ":10: ", "the section CELL_TYPES is missing"},
      {"unknown word", good + "CELLDATA 2\n", ":14: ", "'CELLDATA' is not expected here"},
      {"array before data", good + "SCALARS a int\n", ":14: ", "'SCALARS' is not expected here"},
      {"bad type", replaced(good, "double", "quad"), ":5: ", "'quad' is not a data type"},
      {"points as text", replaced(good, "double", "string"),
       ":5: ", "points cannot be of type 'string'"},
      {"huge points", replaced(good, "POINTS 4 ", "POINTS 4000000000 "), ":5: ", "cannot fit"},
      {"too many points", replaced(good, "POINTS 4 ", "POINTS 99999999999 "),
       ":5: ", "99999999999 vertices are too many"},
      {"negative points", replaced(good, "POINTS 4 ", "POINTS -4 "),
       ":5: ", "'-4' is out of range"},
      {"too few numbers", replaced(good, "0 0 0 1\n", "0 0 1\n"),
       ":8: ", "'CELLS' is not a number"},
      {"too many numbers", replaced(good, "0 0 0 1\n", "0 0 0 0 1\n"),
       ":7: ", "'1' is not expected here"},
      {"nan", replaced(good, "0 0 0 1\n", "0 0 0 nan\n"), ":7: ", "'nan' is not a finite number"},
      {"text in number", replaced(good, "0 0 0 1\n", "0 0 0 1.0x\n"),
       ":7: ", "'1.0x' is not a number"},
      {"fraction", replaced(good, "4 0 1 2 3", "4 0 1 2.0 3"), ":9: ", "'2.0' is not an integer"},
      {"index 4", replaced(good, "4 0 1 2 3", "4 0 1 4 3"),
       ":9: ", "'4' is out of range: expected a vertex number, 0 to 3"},
      {"index -1", replaced(good, "3 0 1 2\n", "3 0 -1 2\n"), ":10: ", "'-1' is out of range"},
      {"index of 64 bits", replaced(good, "4 0 1 2 3", "4 0 1 4294967298 3"),
       ":9: ", "'4294967298' is out of range: expected a vertex number, 0 to 3"},
      {"index behind one of 64 bits",
       replaced(good, "2 9\n4 0 1 2 3\n3 0 1 2\n", "2 9\n4 0 1 2 3\n2 4294967298 1 7\n"),
       ":10: ", "'2' is not the number of vertices of a triangle: expected 3"},
      {"tet of 3", replaced(good, "10\n5", "5\n10"),
       ":9: ", "'4' is not the number of vertices of a triangle: expected 3"},
      {"size too great", replaced(good, "3 0 1 2\n", "9 0 1 2\n"),
       ":10: ", "'9' is wrong: expected the number of vertices of a cell, at most 3"},
      {"size negative", replaced(good, "3 0 1 2\n", "-3 0 1 2\n"), ":10: ", "'-3' is wrong"},
      {"more integers", replaced(good, "2 9\n4 0 1 2 3\n3 0 1 2\n", "2 10\n4 0 1 2 3\n3 0 1 2 0\n"),
       ":10: ", "take 9 integers: expected 10"},
      {"fewer cells", replaced(good, "CELLS 2 9", "CELLS 3 9"),
       ":12: ", "2 cell types for 3 cells"},
      {"cells end", replaced(replaced(good, "CELLS 2 9", "CELLS 3 9"), "2\n10\n5", "3\n10\n5\n5"),
       "", "the cells end too early"},
      {"huge cells", replaced(good, "CELLS 2 9", "CELLS 2 99999999999"), ":8: ", "cannot fit"},
      {"huge types", replaced(good, "TYPES 2", "TYPES 9223372036854775807"), ":11: ", "cannot fit"},
      {"polyhedron", replaced(good, "10\n5", "42\n5"),
       ":12: ", "type '42' (polyhedron) cannot be read"},
      {"third order", replaced(good, "10\n5", "71\n5"),
       ":12: ", "(tetrahedron of higher order) cannot be read"},
      {"unknown type", replaced(good, "10\n5", "10\n-5"), ":13: ", "type '-5' (no type of VTK)"},
      {"twice", good + kVtkPoints, ":14: ", "'POINTS' appears for the second time"},
      {"data of others", good + "CELL_DATA 3\n",
       ":14: ", "data of 3 cells do not belong to this mesh: expected 2"},
      {"data before cells", kHead + kVtkPoints + cell_data, ":8: ", "expected the cells before"},
      {"label", good + cell_data + "SCALARS label long\nLOOKUP_TABLE d\n1 2147483648\n",
       ":17: ", "the label 2147483648 is out of range"},
      {"label word", good + cell_data + "SCALARS label int\nLOOKUP_TABLE d\n1 x\n",
       ":17: ", "'x' is not an integer"},
      {"huge field", good + cell_data + "FIELD f 1\na 4294967296 4294967296 int\n",
       ":16: ", "cannot fit"},
      {"cut", good + cell_data + "SCALARS label int\nLOOKUP_TABLE d\n1 2",
       ":17: ", "the file ends right behind '2'"},
      {"5.1 without offsets", kHead5 + kVtkPoints + "CELLS 2 9\n4 0 1 2 3\n",
       ":9: ", "'4' is not expected here: expected OFFSETS"},
      {"5.1 of reals", replaced(good5, "OFFSETS vtktypeint64", "OFFSETS double"),
       ":9: ", "cannot be of type double"},
      {"5.1 falling", replaced(good5, "0 4 7", "0 4 3"),
       ":10: ", "the offsets 4 and 3 of a cell are wrong"},
      {"5.1 too great", replaced(good5, "0 4 7", "0 4 8"),
       ":10: ", "the offsets 4 and 8 of a cell are wrong"},
      {"5.1 negative", replaced(good5, "0 4 7", "-1 4 7"), ":10: ", "the offsets -1 and 4"},
      {"5.1 too small", replaced(good5, "0 4 7", "0 4 4"), "",
       "'0' is not the number of vertices of a triangle"},
      {"binary cut", binary + std::string(95, '\0'),
       ": byte 71: ", "4 times 3 values cannot fit into the 95 bytes"},
      {"binary nan",
       Bytes(std::endian::big)
           .text(binary)
           .add_all<double>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, NAN})
           .text("\n")
           .str(),
       ": byte 166: ", "nan is not a finite number"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.vtk", bad.content);
    const std::string error = error_of_reading(folder / "a.vtk");
    CHECK_MESSAGE(error.starts_with("a.vtk" + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
