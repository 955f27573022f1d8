// SPDX-License-Identifier: MIT
// VTK XML files made by hand, files packed by gzip, and how bad ones are refused.
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "contract/zoo.h"
#include "kernel/formats/base64.h"
#include "kernel/formats/compression.h"
#include "kernel/formats/output_file.h"
#include "kernel/formats/packed_file.h"
#include "kernel/formats/vtu_blocks.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const std::string kOpening =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
    "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
const std::string kEnd = "</UnstructuredGrid>\n</VTKFile>\n";

std::string array(const std::string& name, const std::string& type, const std::string& values,
                  int components = 1) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"ascii\">\n" + values + "\n</DataArray>\n";
}

std::string piece(const std::string& data) {
  return "<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\n" + data + "<Points>\n" +
         array("Points", "Float32", "0 0 0 1 0 0 0 1 0 0.25 0 1", 3) + "</Points>\n<Cells>\n" +
         array("connectivity", "Int64", "0 1 2 3 0 1 2") + array("offsets", "Int64", "4 7") +
         array("types", "UInt8", "10 5") + "</Cells>\n</Piece>\n";
}

}  // namespace

TEST_CASE("a VTK XML file gives points, elements, labels and arrays") {
  const MeshData mesh =
      read_as("a.vtu", kOpening + "<FieldData><DataArray/></FieldData>\n" +
                           piece("<PointData>\n" + array("T", "Float64", "1 nan 3 -4e2") +
                                 array("who", "String", "65") + "</PointData>\n<CellData>\n" +
                                 array("Material", "Int32", "7 -8") +
                                 array("x&amp;y", "UInt16", "1 2 3 65535", 2) + "</CellData>\n") +
                           kEnd);
  CHECK(mesh.points[3] == Point(0.25, 0, 1));
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 7}});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, -8}});
  CHECK(mesh.label_array == "Material");
  REQUIRE(mesh.tet_data.size() == 1);
  CHECK(mesh.triangle_data ==
        std::vector<DataArray>{{"x&y", 2, std::vector<std::int32_t>{3, 65535}}});
  CHECK(mesh.point_data.size() == 1);
  CHECK(mesh.notes == std::vector<std::string>{"the field data are not kept",
                                               "the array 'who' is not kept: it holds no numbers"});
}

TEST_CASE("the pieces of a VTK XML file become one mesh") {
  const std::string both = "<CellData>\n" + array("label", "Int32", "1 2") + "</CellData>\n";
  const std::string more = "<CellData>\n" + array("label", "Int32", "3 4") +
                           array("q", "Float32", "0 0") + "</CellData>\n";
  const MeshData mesh = read_as("a.vtu", kOpening + piece(both) + piece(more) + kEnd);
  CHECK(mesh.points.size() == 8);
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 1}, {{4, 5, 6, 7}, 3}});
  CHECK(mesh.tet_data.empty());
  CHECK(mesh.notes ==
        std::vector<std::string>{"the array 'q' is not kept: not every piece has it"});
}

TEST_CASE("labels are guessed from the only array that could hold them, else asked for") {
  const TempFolder folder;
  MeshData mesh = contract::kuhn_cube(2, 0, 1);
  std::vector<std::int32_t> region, id, owner;
  std::vector<double> zone;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    region.push_back(t % 2 == 0 ? 5 : 6);
    owner.push_back(t % 3 == 0 ? 1 : 2);
    zone.push_back(t % 2 == 0 ? 1 : 2);
    id.push_back(static_cast<std::int32_t>(1000 + t));
  }
  const auto read_with = [&](std::vector<DataArray> arrays, const std::string& wanted) {
    mesh.tet_data = std::move(arrays);
    write_mesh(folder / "a.vtu", mesh);
    return read_mesh(folder / "a.vtu", wanted);
  };
  const MeshData one = read_with({{"id", 1, id}, {"my_region", 1, region}}, "");
  CHECK(one.label_array == "my_region");
  CHECK(one.tets[0].label == 5);
  CHECK(one.notes.empty());
  const MeshData two = read_with({{"owner", 1, owner}, {"my_region", 1, region}}, "");
  CHECK(two.label_array.empty());
  REQUIRE(two.notes.size() == 1);
  CHECK(two.notes[0].find("'owner', 'my_region' might hold them") != std::string::npos);
  // A part for each combination of the two.
  CHECK(std::set<Label>(two.tet_parts.begin(), two.tet_parts.end()).size() == 4);
  const MeshData doubles = read_with({{"colour", 1, zone}}, "");
  CHECK(doubles.label_array == "colour");
  CHECK(doubles.notes.empty());
  const std::vector<std::int32_t> same(zone.size(), 3);
  CHECK(
      read_with({{"one", 1, same}, {"colour", 1, zone}, {"owner", 1, owner}, {"two", 1, same}}, "")
          .label_array == "owner");
  CHECK(read_with({{"vtkProcessId", 1, owner}, {"my_region", 1, region}}, "").label_array ==
        "my_region");
  const MeshData known = read_with({{"ObjectId", 1, region}, {"subdomain_id", 1, owner}}, "");
  CHECK(known.label_array == "subdomain_id");
  CHECK(std::set<Label>(known.tet_parts.begin(), known.tet_parts.end()).size() == 2);
  CHECK(known.notes.size() == 1);
  CHECK(read_with({{"ObjectId", 1, owner}, {"subdomain_id", 1, owner}}, "").tet_parts.empty());
  CHECK(read_with({{"zone", 1, zone}}, "zone").tets[1].label == 2);
  CHECK(read_with({{"zone", 1, zone}}, "none").notes.empty());
  // Without labels there is no array of them.
  CHECK(read_text(folder / "a.vtu").find("CellEntityIds") == std::string::npos);
}

TEST_CASE("a VTK XML file of text stays one, and names the roles of its arrays") {
  const TempFolder folder;
  const std::string text = R"(<VTKFile type="UnstructuredGrid"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3">
0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>
<DataArray type="Int64" Name="connectivity">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets">4</DataArray><DataArray type="UInt8" Name="types">10</DataArray></Cells>
<PointData Scalars="a &amp; b" GlobalIds="id" Vectors="none"><DataArray type="Float32" Name="a &amp; b">0.1 2 3 nan</DataArray>
<DataArray type="Int64" IdType="1" Name="id">1 2 3 9</DataArray></PointData>
</Piece></UnstructuredGrid></VTKFile>)";
  write_text(folder / "a.vtu", text);
  const MeshData mesh = read_mesh(folder / "a.vtu");
  for (const std::string_view variant : {"", "binary"}) {
    MeshView view(mesh);
    view.set_variant(variant);
    write_mesh(folder / "b.vtu", view);
    const std::string written = read_text(folder / "b.vtu");
    CHECK((written.find("format=\"binary\"") == std::string::npos) == variant.empty());
    CHECK(written.find("<PointData Scalars=\"a &amp; b\" GlobalIds=\"id\">") != std::string::npos);
    CHECK(written.find("type=\"Int64\" IdType=\"1\" Name=\"id\"") != std::string::npos);
    const MeshData again = read_mesh(folder / "b.vtu");
    CHECK(again.points == mesh.points);
    CHECK(again.point_data[1] == mesh.point_data[1]);
    CHECK(std::get<std::vector<float>>(again.point_data[0].values)[0] == 0.1F);
  }
}

TEST_CASE("an array with integers of 64 bits and no sign is noted if they are too great") {
  const TempFolder folder;
  const std::string text = R"(<VTKFile type="UnstructuredGrid"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3">
0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>
<DataArray type="Int64" Name="connectivity">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets">4</DataArray><DataArray type="UInt8" Name="types">10</DataArray></Cells>
<PointData><DataArray type="UInt64" Name="id">1 2 3 18446744073709551613</DataArray></PointData>
</Piece></UnstructuredGrid></VTKFile>)";
  write_text(folder / "a.vtu", text);
  const MeshData mesh = read_mesh(folder / "a.vtu");
  CHECK(mesh.point_data.empty());
  REQUIRE(mesh.notes.size() == 1);
  CHECK(mesh.notes[0].find("'id' is not kept") != std::string::npos);
}

TEST_CASE("a bad VTK XML file is refused with line and reason") {
  const std::string good = kOpening + piece("") + kEnd;
  CHECK(read_as("a.vtu", good).tets.size() == 1);
  const std::string packed =
      replaced(good, "version=\"0.1\"", "version=\"0.1\" compressor=\"vtkZLibDataCompressor\"");
  const auto inline_points = [](const std::string& text, const std::string& data) {
    return replaced(replaced(text, "NumberOfComponents=\"3\" format=\"ascii\"",
                             "NumberOfComponents=\"3\" format=\"binary\""),
                    "0 0 0 1 0 0 0 1 0 0.25 0 1", data);
  };
  const std::vector<BadFile> files = {
      {"no XML", "solid cube", ":1: ", "is not the beginning of a VTK XML file"},
      {"other root", "<html></html>", ":1: ", "expected the element VTKFile"},
      {"other type", replaced(good, "Unstr", "Str"), ":2: ", "'StructuredGrid' cannot be read"},
      {"cut", good.substr(0, good.size() - 30), ":", "the XML is broken"},
      {"other packer", replaced(packed, "ZLib", "LZ5"), ":2: ", "'vtkLZ5DataCompressor'"},
      {"no count", replaced(good, "NumberOfCells=\"2\"", "NumberOfCells=\"x\""),
       ":4: ", "NumberOfCells is 'x': expected a count"},
      {"huge count", replaced(good, "NumberOfPoints=\"4\"", "NumberOfPoints=\"1000000000\""),
       ":6: ", "1000000000 times 3 values cannot fit into the file"},
      {"more than any mesh",
       replaced(good, "NumberOfPoints=\"4\"", "NumberOfPoints=\"5000000000\""),
       ":4: ", "5000000000 vertices are too many"},
      {"few values", replaced(good, "0.25 0 1", "0.25 0"),
       ":6: ", "there are 11 values: expected 12"},
      {"no number", replaced(good, "0.25 0 1", "0.25 0 z"), ":6: ", "'z' is not a value"},
      {"not finite", replaced(good, "0.25 0 1", "inf 0 1"), ":6: ", "point 3 is not finite"},
      {"vertex", replaced(good, "0 1 2 3 0", "0 1 2 4 0"), ":10: ", "'4' is out of range"},
      {"offsets", replaced(good, "4 7", "7 4"), ":11: ", "there are 7 values: expected 4"},
      {"offset type", replaced(good, "Int64\" Name=\"offsets", "Float32\" Name=\"offsets"),
       ":14: ", "the values are no integers"},
      {"tets of higher order", replaced(good, "10 5", "78 5"),
       ":10: ", "(tetrahedron of higher order) cannot be read"},
      {"no base64", inline_points(good, "!!!!"), ":6: ", "the data are truncated"},
      {"wrong size", inline_points(good, formats::encode_base64(std::string("\x30\0\0\1", 4))),
       ":6: ", "the array has 16777264 bytes: expected 48"},
      {"blocks that make no sense",
       inline_points(packed, formats::encode_base64(std::string(12, '\x7f'))),
       ":6: ", "make no sense"},
      {"no place", replaced(good, "format=\"ascii\"", "format=\"appended\" offset=\"99\""),
       ":6: ", "the offset 99 is behind the end"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    write_text(folder / "a.vtu", bad.content);
    const std::string error = error_of_reading(folder / "a.vtu");
    CAPTURE(bad.what);
    CAPTURE(error);
    CHECK(error.starts_with("a.vtu" + bad.place));
    CHECK(error.find(bad.reason) != std::string::npos);
  }
}

TEST_CASE("files are read and written packed by gzip, and damaged ones refused") {
  const TempFolder folder;
  for (const std::string name : {"a.mesh", "a.meshb", "a.vtk", "a.vtu"}) {
    CAPTURE(name);
    write_mesh(folder / name, awkward_mesh());
    write_mesh(folder / (name + ".gz"), awkward_mesh());
    const std::string packed = read_text(folder / (name + ".gz"));
    CHECK(formats::is_gzip(packed));
    const formats::Inflated content = formats::inflate_gzip(packed);
    CHECK(std::string(content.bytes.get(), content.size) == read_text(folder / name));
    CHECK(read_mesh(folder / (name + ".gz")).tets == read_mesh(folder / name).tets);
    write_text(folder / "two.gz", packed + packed);
    CHECK(formats::inflate_gzip(read_text(folder / "two.gz")).size == 2 * content.size);
    write_text(folder / ("b" + name + ".gz"), packed.substr(0, packed.size() - 9));
    CHECK(error_of_reading(folder / ("b" + name + ".gz")).find("gzip file is truncated") !=
          std::string::npos);
    std::string damaged = packed;
    damaged[damaged.size() - 6] ^= 1;
    write_text(folder / ("b" + name + ".gz"), damaged);
    CHECK(error_of_reading(folder / ("b" + name + ".gz")).find("gzip file is damaged") !=
          std::string::npos);
  }
  CHECK_THROWS_AS(write_mesh(folder / "a.node.gz", awkward_mesh()), Error);
}

namespace {

// MEDIT's text of one tet, packed by the programs xz, zstd and bzip2.
constexpr std::string_view kXz =
    "/Td6WFoAAATm1rRGAgAhARYAAAB0L+"
    "Wj4ABoAFVdACaZSmaZdKqxXd3sHo3WwKIwLgRUMxc08OP74MEbnZrEZMQUgjT3l5Ag"
    "6FkHvTcVhT9DfXWoliWqhhgkTWVbDUFjXPGmTCMZ0KkhBu2jMVSo8GhyzWAAAAAAGbpWbXs5hUwAAXFpYCTMIh+"
    "2830BAAAA"
    "AARZWg==";
constexpr std::string_view kBzip2 =
    "QlpoOTFBWSZTWVAQlFoAAB1fgAAQQAB8gAcCBQAuY5wAIABUNU9T1PUyDTEaP0UEqfqppkaaAAE4mbL26m0sGExFCNnc5U"
    "rA"
    "KiiIgokkGEcEsREmIcvj2fyilID9KIO2rAXnoi8fi7kinChIKAhKLQA=";
constexpr std::string_view kZstd =
    "KLUv/QRYnQIAEgURFqA3HQCwMgIu23TXn/+4S2rENv3qGQI9F6jhwoQHV6sGzxGD6YSWS9WlRfMFS/"
    "ijhA9Z3hMDdPB5SiZB"
    "JDhkiT+Q/CAEAC0CgDxWEkOtgwLbxhOY";

std::string decoded(std::string_view base64, std::size_t size) {
  std::string bytes;
  formats::decode_base64(base64, size, bytes);
  return bytes;
}

}  // namespace

TEST_CASE(
    "files packed by xz, Zstandard and bzip2 are read, damaged ones refused, none is written") {
  const TempFolder folder;
  struct Packed {
    std::string extension;
    std::string bytes;
  };
  for (const Packed& packed :
       {Packed{".xz", decoded(kXz, 148)}, Packed{".bz2", decoded(kBzip2, 113)},
        Packed{".zst", decoded(kZstd, 96)}}) {
    CAPTURE(packed.extension);
    const std::filesystem::path file = folder / ("a.mesh" + packed.extension);
    write_text(file, packed.bytes);
    const std::string error = error_of_reading(file);
    if (error.find("tetmend is built without") != std::string::npos) continue;
    CHECK(read_mesh(file).tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 7}});
    CHECK(format_name(file) == "MEDIT ASCII" + packed.extension);
    CHECK(formats::unpack(packed.bytes + packed.bytes).size ==
          2 * formats::unpack(packed.bytes).size);
    for (std::size_t size = 7; size < packed.bytes.size(); ++size) {
      write_text(file, packed.bytes.substr(0, size));
      const std::string cut = error_of_reading(file);
      CHECK_MESSAGE((cut.find("file is truncated") != std::string::npos ||
                     cut.find("file is damaged") != std::string::npos),
                    size, cut);
    }
    std::string damaged = packed.bytes;
    damaged[packed.bytes.size() / 2] ^= 4;
    write_text(file, damaged);
    CHECK(error_of_reading(file) != "no error");
    CHECK_THROWS_AS(write_mesh(file, awkward_mesh()), Error);
  }
}

TEST_CASE("arrays of a VTU file may be packed by LZ4 and LZMA") {
  CHECK(formats::vtu_packing("vtkLZ4DataCompressor") == formats::VtuPacking::lz4);
  // "abcabcabcabcabcabcabcabc" and a block of 300 bytes that repeat one another
  const auto unpacked = [](std::string_view block, std::size_t size) {
    std::string bytes(size, '?');
    const bool is_good = formats::unpack_block(formats::VtuPacking::lz4, block, bytes.data(), size);
    return is_good ? bytes : "bad";
  };
  CHECK(unpacked(std::string_view("\x50hello", 6), 5) == "hello");
  CHECK(unpacked(std::string_view("\x3f"
                                  "abc\x03\x00\x00\x20"
                                  "de",
                                  10),
                 3 + 19 + 2) == "abcabcabcabcabcabcabcade");
  CHECK(unpacked(std::string_view("\x1f"
                                  "a\x01\x00\xff\x1a\x10"
                                  "b",
                                  8),
                 1 + 300 + 1) == std::string(301, 'a') + "b");
  for (const std::string_view bad : {std::string_view("\x50hell", 5),
                                     std::string_view("\x10"
                                                      "a\x02\x00",
                                                      4),
                                     std::string_view("\x10"
                                                      "a\x00\x00",
                                                      4),
                                     std::string_view("\x10"
                                                      "a\x01",
                                                      3),
                                     std::string_view("\xf0", 1),
                                     std::string_view("\x1f"
                                                      "a\x01\x00\xff",
                                                      5)}) {
    CHECK(unpacked(bad, 5) == "bad");
  }
  const TempFolder folder;
  write_text(
      folder / "a.vtu",
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt32\" compressor=\"vtkLZMADataCompressor\">\n"
      "<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n"
      "<PointData>\n"
      "</PointData>\n"
      "<CellData>\n"
      "</CellData>\n"
      "<Points>\n"
      "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"binary\">\n"
      "AQAAAACAAABgAAAARAAAAA==/"
      "Td6WFoAAAFpIt42AsATYCEBFgBcV77y4ABfAAtdAABuFTfEGPHWOxAAAAAIGmJEAAEjYBKjndOQQpkNAQAAAAABWVo="
      "\n"
      "</DataArray>\n"
      "</Points>\n"
      "<Cells>\n"
      "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"binary\">\n"
      "AQAAAACAAAAgAAAARAAAAA==/"
      "Td6WFoAAAFpIt42AsAUICEBFgCtP0i34AAfAAxdAABqfrsUbxtBMbVtagAKEgCRAAEkIEV0AOqQQpkNAQAAAAABWVo="
      "\n"
      "</DataArray>\n"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"binary\">\n"
      "AQAAAACAAAAIAAAAPAAAAA==/"
      "Td6WFoAAAFpIt42AsAMCCEBFgCe23ypAQAHBAAAAAAAAAAAk9Fo4QABHAhEYCrIkEKZDQEAAAAAAVla\n"
      "</DataArray>\n"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"binary\">\n"
      "AQAAAACAAAABAAAAOAAAAA==/"
      "Td6WFoAAAFpIt42AsAFASEBFgAn6GODAQAACgAAAACTBtcyAAEVAaljNGCQQpkNAQAAAAABWVo=\n"
      "</DataArray>\n"
      "</Cells>\n"
      "</Piece>\n"
      "</UnstructuredGrid>\n"
      "</VTKFile>\n");
  if (formats::can_unpack(formats::VtuPacking::lzma)) {
    CHECK(read_mesh(folder / "a.vtu").tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 0}});
  }
}

TEST_CASE("a file that was packed to use memory up is refused before it has") {
  CHECK_FALSE(formats::is_bomb(1, std::size_t{1} << 23));
  CHECK(formats::is_bomb(1, (std::size_t{1} << 23) + 1));
  CHECK_FALSE(formats::is_bomb(std::size_t{1} << 20, std::size_t{200} << 20));
  CHECK(formats::is_bomb(std::size_t{1} << 20, std::size_t{202} << 20));
  const TempFolder folder;
  std::string packed;
  formats::GzipWriter writer([&](std::string_view bytes) { packed += bytes; });
  const std::string blanks(std::size_t{1} << 20, ' ');
  for (int i = 0; i < 100; ++i) writer.put(blanks);
  writer.finish();
  REQUIRE(packed.size() < std::size_t{1} << 18);
  write_text(folder / "bomb.mesh", packed);
  CHECK(error_of_reading(folder / "bomb.mesh").find("hundreds of times its size") !=
        std::string::npos);
}

TEST_CASE("a packed VTU file of tags, and one whose arrays are the same bytes, are refused") {
  const TempFolder folder;
  const auto packed = [](const std::string& text) {
    std::string bytes;
    formats::GzipWriter writer([&](std::string_view some) { bytes += some; });
    writer.put(text);
    writer.finish();
    return bytes;
  };
  std::string tags = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>";
  for (int i = 0; i < 1000000; ++i) tags += "<a/>";
  tags += "</UnstructuredGrid></VTKFile>";
  write_text(folder / "a.vtu", packed(tags));
  CHECK(error_of_reading(folder / "a.vtu").find("tags, more than a mesh of its size") !=
        std::string::npos);
  write_text(folder / "a.vtu", tags);  // takes twenty times its size, and is no mesh
  CHECK(error_of_reading(folder / "a.vtu").find("no Piece is here") != std::string::npos);

  constexpr std::uint64_t kPoints = 20000;
  constexpr std::uint64_t kBytes = kPoints * 3 * sizeof(double);
  std::string size(sizeof kBytes, '\0');
  std::memcpy(size.data(), &kBytes, sizeof kBytes);
  const auto sharing = [&](int arrays) {
    const auto array = [](int i) {
      return fmt::format(
          "<DataArray type=\"Float64\" Name=\"x{}\" NumberOfComponents=\"3\" "
          "format=\"appended\" offset=\"0\"/>",
          i);
    };
    std::string text = fmt::format(
        "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt64\"><UnstructuredGrid>"
        "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"0\"><Points>{}</Points><PointData>",
        kPoints, array(0));
    for (int i = 1; i < arrays; ++i) text += array(i);
    text += "</PointData></Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_" + size;
    return text + std::string(kBytes, '\0') + "</AppendedData></VTKFile>";
  };
  write_text(folder / "b.vtu", sharing(20));
  CHECK(error_of_reading(folder / "b.vtu").find("hundreds") == std::string::npos);
  write_text(folder / "b.vtu", sharing(400));
  CHECK(error_of_reading(folder / "b.vtu").find("hundreds of times the size") != std::string::npos);
}

TEST_CASE("base64 goes there and back, over padding and white space") {
  for (std::size_t size = 0; size < 10; ++size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(200 + 7 * i);
    const std::string text = formats::encode_base64(bytes);
    CHECK(text.size() % 4 == 0);
    std::string decoded;
    std::string_view rest = text;
    formats::decode_base64(rest, size, decoded);
    CHECK(decoded.substr(0, size) == bytes);
  }
  std::string decoded;
  std::string_view two = " QQ==\nQkM= rest!";
  formats::decode_base64(two, 100, decoded);
  CHECK(decoded.starts_with("ABC"));
}
