// SPDX-License-Identifier: MIT
// XDMF files: grids of tags, numbers in the file, steps, and elements that make no sense.
#include "kernel/formats/xdmf.h"

#include <doctest/doctest.h>

#include "kernel/formats/hdf5_file.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Two tets with a scalar, and tags of one of their faces, with all numbers in the file.
std::string small_xdmf() {
  return R"xdmf(<?xml version="1.0"?>
<!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" []>
<Xdmf Version="3.0" xmlns:xi="https://www.w3.org/2001/XInclude">
 <Domain>
  <Grid Name="mesh" GridType="Uniform">
   <Topology TopologyType="Tetrahedron" NumberOfElements="2" NodesPerElement="4">
    <DataItem Dimensions="2 4" NumberType="Int" Format="XML">0 1 2 3  0 2 1 4</DataItem>
   </Topology>
   <Geometry GeometryType="XYZ">
    <DataItem Dimensions="5 3" Format="XML">0 0 0  1 0 0  0 1 0  0 0 1  0 0 -1</DataItem>
   </Geometry>
  </Grid>
  <Grid Name="parts" GridType="Uniform">
   <xi:include xpointer="xpointer(/Xdmf/Domain/Grid/Geometry)" />
   <Topology TopologyType="Tetrahedron" NumberOfElements="2" NodesPerElement="4">
    <DataItem Dimensions="2 4" NumberType="Int" Format="XML">1 4 2 0  0 1 2 3</DataItem>
   </Topology>
   <Attribute Name="parts" AttributeType="Scalar" Center="Cell">
    <DataItem Dimensions="2 1" NumberType="Int" Format="XML">8 7</DataItem>
   </Attribute>
  </Grid>
  <Grid Name="walls" GridType="Uniform">
   <xi:include xpointer="xpointer(/Xdmf/Domain/Grid/Geometry)" />
   <Topology TopologyType="Triangle" NumberOfElements="1" NodesPerElement="3">
    <DataItem Dimensions="1 3" NumberType="Int" Format="XML">0 1 3</DataItem>
   </Topology>
   <Attribute Name="walls" AttributeType="Scalar" Center="Cell">
    <DataItem Dimensions="1 1" NumberType="Int" Format="XML">5</DataItem>
   </Attribute>
  </Grid>
  <Grid Name="u" GridType="Collection" CollectionType="Temporal">
   <Grid Name="u" GridType="Uniform">
    <xi:include xpointer="xpointer(/Xdmf/Domain/Grid[1]/*[self::Topology or self::Geometry])" />
    <Time Value="0" />
    <Attribute Name="u" AttributeType="Scalar" Center="Node">
     <DataItem Dimensions="5 1" Format="XML">1 2 3 4 5</DataItem>
    </Attribute>
   </Grid>
   <Grid Name="u" GridType="Uniform">
    <Time Value="1" />
    <Attribute Name="u" AttributeType="Scalar" Center="Node">
     <DataItem Dimensions="5 1" Format="XML">6 7 8 9 10</DataItem>
    </Attribute>
   </Grid>
  </Grid>
 </Domain>
</Xdmf>
)xdmf";
}

}  // namespace

TEST_CASE("grids of tags label the tets and faces of an XDMF file, and the first step is kept") {
  const TempFolder folder;
  write_text(folder / "a.xdmf", small_xdmf());
  const MeshData mesh = read_mesh(folder / "a.xdmf");
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 7}, {{0, 2, 1, 4}, 8}});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 3}, 5}});
  REQUIRE(mesh.point_data.size() == 1);
  CHECK(mesh.point_data[0] == DataArray{"u", 1, std::vector<double>{1, 2, 3, 4, 5}});
  CHECK(mesh.notes == std::vector<std::string>{"of the 2 steps of 'u' only the first is kept"});
}

TEST_CASE("an XDMF file comes back with its grids of tags under their names") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  write_text(folder / "a.xdmf", small_xdmf());
  const MeshData mesh = read_mesh(folder / "a.xdmf");
  CHECK(not_written(folder / "b.xdmf", mesh).empty());
  write_mesh(folder / "b.xdmf", mesh);
  CHECK(std::filesystem::exists(folder / "b.h5"));
  const MeshData again = read_mesh(folder / "b.xdmf");
  CHECK(again.tets == mesh.tets);
  CHECK(again.triangles == mesh.triangles);
  CHECK(again.point_data == mesh.point_data);
  for (const char* name : {"Grid Name=\"parts\"", "Grid Name=\"walls\"", "Grid Name=\"mesh\""}) {
    CHECK(read_text(folder / "b.xdmf").find(name) != std::string::npos);
  }
}

TEST_CASE("arrays whose names are no text, or end in blanks, have tables that XDMF finds again") {
  if (!formats::has_hdf5()) return;
  const TempFolder folder;
  write_text(folder / "a.xdmf", small_xdmf());
  MeshData mesh = read_mesh(folder / "a.xdmf");
  mesh.point_data.clear();
  for (const char* name : {"\xe9q", "\xc3\xa9q", "T ", " T", "a/b", "a_b", ".", "..", "x\ny"})
    mesh.point_data.push_back(
        {name, 1, std::vector<double>(5, static_cast<double>(mesh.point_data.size()))});
  write_mesh(folder / "b.xdmf", mesh);
  const MeshData again = read_mesh(folder / "b.xdmf");
  REQUIRE(again.point_data.size() == mesh.point_data.size());
  for (std::size_t k = 0; k < mesh.point_data.size(); ++k)
    CHECK(again.point_data[k].values == mesh.point_data[k].values);
}

TEST_CASE("faces of tags have no values of the arrays of the mesh of XDMF") {
  const TempFolder folder;
  write_text(folder / "a.xdmf",
             replaced(small_xdmf(), "</Geometry>\n  </Grid>",
                      "</Geometry>\n   <Attribute Name=\"rho\" Center=\"Cell\">\n"
                      "    <DataItem Dimensions=\"2 1\" Format=\"XML\">3 4</DataItem>\n"
                      "   </Attribute>\n  </Grid>"));
  const MeshData mesh = read_mesh(folder / "a.xdmf");
  CHECK(mesh.tet_data == std::vector<DataArray>{{"rho", 1, std::vector<double>{3, 4}}});
  CHECK(mesh.triangles.size() == 1);
  CHECK(mesh.triangle_data.empty());
}

TEST_CASE("XDMF that makes no sense is refused with file, line and reason") {
  struct Case {
    std::string_view what, by, error;
  };
  const std::vector<Case> bad = {
      {"0 2 1 4", "0 2 1", "a.xdmf:7: the numbers end within a cell"},
      {"0 2 1 4", "0 2 1 x", "a.xdmf:7: 'x' is not a number"},
      {"\"XYZ\"", "\"XY\"", "a.xdmf:9: the geometry 'XY' cannot be read: expected XYZ or X_Y_Z"},
      {"0 0 -1<", "0 0<", "a.xdmf:10: 14 numbers are not three for each point"},
      {"0 0 -1<", "0 0 nan<", "a.xdmf:10: a coordinate of point 5 is not finite"},
      {"\"Tetrahedron\"", "\"Tetrahedron_99\"", "a.xdmf:6: cells of type 'tetrahedron_99'"},
      {"Format=\"XML\"", "Format=\"TIFF\"", "a.xdmf:7: data of format 'TIFF' cannot be read"},
      {"Format=\"XML\"", "Format=\"Binary\" Precision=\"3\"",
       "a.xdmf:7: binary data of type 'int' and 3 bytes cannot be read"},
      {"NumberOfElements=\"2\"", "NumberOfElements=\"3\"",
       "a.xdmf:6: 2 cells are here: expected 3"},
      {"NumberOfElements=\"2\"", "BaseOffset=\"1\"", "a.xdmf:6: points that do not count from 0"},
      {"\"Triangle\" NumberOfElements=\"1\" NodesPerElement=\"3\"",
       "\"Polyline\" NodesPerElement=\"3\"", "a.xdmf:"},
      {"\"2 4\" NumberType=\"Int\" Format=\"XML\">0 1 2 3  0 2 1 4",
       "\"2 4\" Format=\"XML\">0 1 2 3  0 2 1 1e300", "a.xdmf:7: '1e+300' is not the number"},
      {"\"Tetrahedron\" NumberOfElements=\"2\" NodesPerElement=\"4\">\n    <DataItem "
       "Dimensions=\"2 4\" "
       "NumberType=\"Int\" Format=\"XML\">0 1 2 3  0 2 1 4",
       "\"Mixed\">\n    <DataItem Dimensions=\"11\" NumberType=\"Int\" Format=\"XML\">6 0 1 2 3 2 "
       "3 0 1 4 6",
       "a.xdmf:7: lines of 3 points cannot be read: expected 2"},
      {"Format=\"XML\">0 1 2 3  0 2 1 4", "Format=\"HDF\">a\n.h5:/t",
       "a.xdmf:7: 'a\\n.h5' is no name of a file"},
      {"</Domain>", "</Domai>", "a.xdmf:"}};
  for (const Case& each : bad) {
    CAPTURE(each.error);
    const TempFolder folder;
    write_text(folder / "a.xdmf", replaced(small_xdmf(), each.what, each.by));
    CHECK(error_of_reading(folder / "a.xdmf").starts_with(each.error));
  }
}

TEST_CASE("points of XDMF axis by axis, and numbers of a binary file, are read as any others") {
  const TempFolder folder;
  write_text(folder / "a.xdmf", small_xdmf());
  const MeshData mesh = read_mesh(folder / "a.xdmf");
  std::string text = replaced(small_xdmf(), "GeometryType=\"XYZ\"", "GeometryType=\"X_Y_Z\"");
  text = replaced(text,
                  "<DataItem Dimensions=\"5 3\" Format=\"XML\">0 0 0  1 0 0  0 1 0  0 0 1  0 0 -1",
                  "<DataItem Dimensions=\"5\" Format=\"XML\">0 1 0 0 0</DataItem>\n"
                  "<DataItem Dimensions=\"5\" Format=\"XML\">0 0 1 0 0</DataItem>\n"
                  "<DataItem Dimensions=\"5\" Format=\"XML\">0 0 0 1 -1");
  write_text(folder / "b.xdmf", text);
  CHECK(read_mesh(folder / "b.xdmf").points == mesh.points);
  write_text(folder / "b.xdmf", replaced(text, "0 0 0 1 -1", "0 0 0 1"));
  CHECK(error_of_reading(folder / "b.xdmf").find("the axes have different lengths") !=
        std::string::npos);
  std::string bytes(3, 'x');  // before the numbers, the highest byte of which comes first
  for (const char vertex : {'\0', '\1', '\2', '\3', '\0', '\2', '\1', '\4'}) {
    bytes += std::string(3, '\0') + vertex;
  }
  write_text(folder / "cells.bin", bytes);
  const std::string binary =
      replaced(small_xdmf(), "NumberType=\"Int\" Format=\"XML\">0 1 2 3  0 2 1 4",
               "NumberType=\"Int\" Format=\"Binary\" Endian=\"Big\" Seek=\"3\">cells.bin");
  write_text(folder / "c.xdmf", binary);
  CHECK(read_mesh(folder / "c.xdmf").tets == mesh.tets);
  write_text(folder / "cells.bin", bytes.substr(0, 34));
  CHECK(error_of_reading(folder / "c.xdmf").find("cannot fit into the 34 bytes of") !=
        std::string::npos);
}

TEST_CASE("grids that lie in each other without end are refused, and point elements are told") {
  const TempFolder folder;
  std::string text = "<Xdmf><Domain>";
  for (int i = 0; i < 1000; ++i) text += "<Grid GridType=\"Tree\">";
  for (int i = 0; i < 1000; ++i) text += "</Grid>";
  write_text(folder / "a.xdmf", text + "</Domain></Xdmf>");
  CHECK(error_of_reading(folder / "a.xdmf").find("more than 100 grids lie in each other") !=
        std::string::npos);
  MeshData mesh = awkward_mesh();
  mesh.other_elements = {{1, 1, {0}, {3}, {}, {}, {}}};
  CHECK(!not_written(folder / "a.xdmf", mesh).empty());
}
