// SPDX-License-Identifier: MIT
// A file that is read slice by slice gives the pieces that its arrays give, for any number of ranks; a
// damaged one gives the error of the reader that has all of it in memory.
#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/io.h>

#include "face/carry.h"
#include "kernel/formats/base64.h"
#include "kernel/formats/compression.h"
#include "pieces/bytes.h"
#include "pieces/improve.h"
#include "pieces/mesh_files.h"
#include "pieces/out_of_core.h"
#include "pieces/slices.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/pieces/meshes.h"
#include "tests/pieces/played_ranks.h"

using namespace tetmend;
using namespace tetmend::test;
using pieces::Ranks;

namespace {

void put_content(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// All stored pieces of a file, put together, and what is protected of them.
pieces::Joined joined_by(const std::function<void(pieces::DividedMesh&)>& add, std::size_t vertices,
                         Ranks& ranks) {
  pieces::MemoryShelf shelf;
  pieces::DividedMesh mesh(shelf, ranks, vertices);
  add(mesh);
  mesh.end_slices();
  mesh.bring_to_first();
  return ranks.is_first() ? pieces::join(mesh, vertices) : pieces::Joined();
}

pieces::Joined in_memory(const std::filesystem::path& file) {
  MeshData data = read_mesh(file);
  const std::vector<MeshData::Triangle> walls = face::walls_between_parts(data);
  data.triangles.insert(data.triangles.end(), walls.begin(), walls.end());
  pieces::OneRank one;
  return joined_by([&](auto& mesh) { pieces::add_slices(data, {}, mesh); }, data.points.size(),
                   one);
}

/// By slices of so few tets that there are many.
pieces::Joined by_slices(const std::filesystem::path& file, Ranks& ranks) {
  const auto slices = pieces::open_slices(file, {}, ranks);
  REQUIRE(slices != nullptr);
  return joined_by([&](auto& mesh) { slices->add_to(mesh, 100); }, slices->counts().vertices,
                   ranks);
}

void check_same(const pieces::Joined& a, const pieces::Joined& b) {
  CHECK(a.data.points == b.data.points);
  CHECK(a.data.point_labels == b.data.point_labels);
  CHECK(a.data.tets == b.data.tets);
  CHECK(a.data.triangles == b.data.triangles);
  CHECK(a.data.edges == b.data.edges);
  CHECK(a.data.required_vertices == b.data.required_vertices);
  CHECK(a.tet_origins == b.tet_origins);
  CHECK(a.vertex_origins == b.vertex_origins);
}

void check_slices(const std::filesystem::path& file) {
  CAPTURE(file.string());
  const pieces::Joined expected = in_memory(file);
  for (const std::size_t count : {1U, 2U, 3U}) {
    CAPTURE(count);
    pieces::Joined found;
    on_ranks(count, [&](Ranks& ranks) {
      pieces::Joined mine = by_slices(file, ranks);
      if (ranks.is_first()) found = std::move(mine);
    });
    check_same(found, expected);
  }
}

void write(const std::filesystem::path& file, const MeshData& data,
           const std::string& variant = {}) {
  MeshView view(data);
  view.set_variant(variant);
  write_mesh(file, view);
}

MeshData shipped(const std::string& name) {
  MeshData data = read_mesh(asset(name));
  data.required_vertices.clear();
  return data;
}

/// Parts that are finer than labels; one face between them is named.
void split_into_parts(MeshData& data) {
  for (const MeshData::Tet& tet : data.tets) {
    data.tet_parts.push_back(data.points[tet.vertices[0]].x() < 3 ? 1
                             : tet.vertices[1] % 40 == 0          ? 3
                                                                  : 2);
  }
  data.triangle_parts.assign(data.triangles.size(), 4);
  const std::vector<MeshData::Triangle> walls = face::walls_between_parts(data);
  data.triangles.push_back(walls[walls.size() / 2]);
  data.triangle_parts.push_back(5);
}

/// What the reader that has all of the file says of it.
std::string reader_complaint(const std::filesystem::path& file) {
  try {
    read_mesh(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

std::string complaint_of_pieces(const std::filesystem::path& file) {
  try {
    pieces::OneRank one;
    const pieces::InputMesh input(file, one);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

/// Cuts the file short and changes bytes of it, at many places.
void check_damage(const std::filesystem::path& good, const std::filesystem::path& bad) {
  const std::string bytes = read_text(good);
  std::size_t complaints = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    const std::size_t at = bytes.size() * i / 60;
    std::string cut = bytes.substr(0, at);
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ (i % 2 == 0 ? 0x15 : 0x80));
    for (const std::string& made : {cut, changed}) {
      put_content(bad, made);
      CAPTURE(at);
      const std::string said = reader_complaint(bad);
      complaints += said == "none" ? 0 : 1;
      REQUIRE(complaint_of_pieces(bad) == said);
    }
  }
  CHECK(complaints > 60);
}

/// As tetmend improve makes it of a file, by ranks and slices, and with all of it in memory.
void check_improved(const std::filesystem::path& in, const std::string& ending) {
  CAPTURE(in.string());
  CAPTURE(ending);
  const std::filesystem::path out = in.parent_path() / ("out" + ending);
  pieces::Division division;
  division.pieces = 4;
  Mesh mesh = load(in);
  pieces::improve(mesh, {}, division);
  save(out, mesh);
  const std::string expected = read_text(out);
  for (const std::size_t count : {1U, 2U, 3U}) {
    CAPTURE(count);
    std::filesystem::remove(out);
    on_ranks(count, [&](Ranks& ranks) {
      pieces::OutOfCore files;
      files.input = in;
      files.output = out;
      if (count == 1) files.scratch = in.parent_path();
      pieces::Division four = division;
      pieces::improve_files(files, {}, four, ranks);
    });
    CHECK(read_text(out) == expected);
  }
}

}  // namespace

TEST_CASE("a Gmsh file that is read slice by slice has the pieces of its arrays") {
  const Folder folder;
  for (const std::string variant : {"4.1 ASCII", "4.1 binary"}) {
    CAPTURE(variant);
    const std::filesystem::path file = folder.path() / "mesh.msh";
    for (const std::string name : {"bracket.meshb", "two_materials.mesh"}) {
      write(file, shipped(name), variant);
      check_slices(file);
    }
    MeshData data = lattice(7);  // with an edge, a triangle, and two labels
    data.required_vertices.clear();
    write(file, data, variant);
    check_slices(file);
    split_into_parts(data);  // a wall between two tets of one label is a triangle
    write(file, data, variant);
    CHECK(face::walls_between_parts(read_mesh(file)).size() > 50);
    check_slices(file);
  }
}

namespace {

/// How the arrays of a VTU file stand there.
struct Encoding {
  enum class Coding { ascii, base64, appended_base64, raw } coding;
  bool is_packed;
  bool has_long_heads;
};

/// Writes files of VTK in all ways that there are.
class VtuText {
 public:
  VtuText(const MeshData& data, const Encoding& encoding) : data_(data), encoding_(encoding) {}

  std::string text() {
    std::string xml = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" "
        "header_type=\"{}\"{}>\n<UnstructuredGrid>\n<FieldData/>\n",
        encoding_.has_long_heads ? "UInt64" : "UInt32",
        encoding_.is_packed ? " compressor=\"vtkZLibDataCompressor\"" : "");
    const std::size_t cells = data_.tets.size() + data_.triangles.size() + data_.edges.size();
    xml += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", data_.points.size(),
                       cells);
    std::vector<double> places;
    for (const Point& p : data_.points) places.insert(places.end(), {p.x(), p.y(), p.z()});
    // Cells of all kinds mixed.
    std::vector<std::int64_t> corners, ends;
    std::vector<std::uint8_t> types;
    std::vector<std::int32_t> labels;
    const auto add = [&](const auto& element, int type) {
      corners.insert(corners.end(), element.vertices.begin(), element.vertices.end());
      ends.push_back(static_cast<std::int64_t>(corners.size()));
      types.push_back(static_cast<std::uint8_t>(type));
      labels.push_back(element.label);
    };
    for (std::size_t i = 0; i < data_.tets.size(); ++i) {
      if (i < data_.triangles.size()) add(data_.triangles[i], 5);
      add(data_.tets[i], 10);
      if (i < data_.edges.size()) add(data_.edges[i], 3);
    }
    xml += "<PointData>\n" + array("medit:ref", "Int32", 1, data_.point_labels) + "</PointData>\n";
    xml += "<CellData>\n" + array("size", "Float64", 1, std::vector<double>(cells, 0.5)) +
           array("material", "Int32", 1, labels) + "</CellData>\n";
    xml += "<Points>\n" + array("p", "Float64", 3, places) + "</Points>\n<Cells>\n";
    xml += array("connectivity", "Int64", 1, corners) + array("offsets", "Int64", 1, ends) +
           array("types", "UInt8", 1, types) + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    if (encoding_.coding == Encoding::Coding::raw) {
      xml += "<AppendedData encoding=\"raw\">\n _" + appended_ + "\n</AppendedData>\n";
    }
    if (encoding_.coding == Encoding::Coding::appended_base64) {
      xml += "<AppendedData encoding=\"base64\">\n _" + appended_ + "\n</AppendedData>\n";
    }
    return xml + "</VTKFile>\n";
  }

 private:
  template <class Value>
  std::string array(std::string_view name, std::string_view type, int components,
                    const std::vector<Value>& values) {
    std::string head = fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"",
                                   type, name, components);
    if (encoding_.coding == Encoding::Coding::ascii) {
      return head + fmt::format(" format=\"ascii\">\n{}\n</DataArray>\n", fmt::join(values, " "));
    }
    const std::string bytes =
        packed({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
    if (encoding_.coding == Encoding::Coding::base64) {
      return head + " format=\"binary\">\n  " + bytes + "\n</DataArray>\n";
    }
    head += fmt::format(" format=\"appended\" offset=\"{}\"/>\n", appended_.size());
    appended_ += bytes;
    return head;
  }
  std::string packed(std::string_view bytes) const {
    constexpr std::size_t kBlock = 1000;
    std::string head, body;
    const auto put_head = [&](std::uint64_t number) {
      if (encoding_.has_long_heads) return pieces::put(number, head);
      pieces::put(static_cast<std::uint32_t>(number), head);
    };
    if (!encoding_.is_packed) {
      put_head(bytes.size());
      head += bytes;
      return coded(head);
    }
    put_head((bytes.size() + kBlock - 1) / kBlock);
    put_head(kBlock);
    put_head(bytes.size() % kBlock);
    for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
      const std::string block = formats::deflate_block(bytes.substr(at, kBlock));
      put_head(block.size());
      body += block;
    }
    return coded(head) + coded(body);
  }
  std::string coded(const std::string& bytes) const {
    return encoding_.coding == Encoding::Coding::raw ? bytes : formats::encode_base64(bytes);
  }

  const MeshData& data_;
  Encoding encoding_;
  std::string appended_;
};

/// With labels of points, and edges and triangles between the tets.
MeshData mixed() {
  MeshData data = lattice(6);
  data.required_vertices.clear();
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    data.point_labels.push_back(static_cast<Label>(i % 3));
  }
  return data;
}

std::vector<Encoding> all_encodings() {
  std::vector<Encoding> all = {{Encoding::Coding::ascii, false, false}};
  for (const auto coding :
       {Encoding::Coding::base64, Encoding::Coding::appended_base64, Encoding::Coding::raw}) {
    for (const bool is_packed : {false, true}) {
      for (const bool is_long : {false, true}) all.push_back({coding, is_packed, is_long});
    }
  }
  return all;
}

}  // namespace

TEST_CASE(
    "a file of VTK in any encoding that is read slice by slice has the pieces of its arrays") {
  const Folder folder;
  const std::filesystem::path file = folder.path() / "mesh.vtu";
  const MeshData data = mixed();
  for (const Encoding& encoding : all_encodings()) {
    CAPTURE(static_cast<int>(encoding.coding));
    CAPTURE(encoding.is_packed);
    CAPTURE(encoding.has_long_heads);
    put_content(file, VtuText(data, encoding).text());
    CHECK(read_mesh(file).label_array == "material");
    check_slices(file);
  }
  for (const std::string name : {"bracket.meshb", "two_materials.mesh"}) {
    write(file, shipped(name));
    check_slices(file);
  }
}

TEST_CASE("a damaged file that would be read by slices has the error of the reader of all of it") {
  const Folder folder;
  MeshData data = lattice(3);
  data.required_vertices.clear();
  for (const std::string variant : {"4.1 ASCII", "4.1 binary"}) {
    write(folder.path() / "good.msh", data, variant);
    check_damage(folder.path() / "good.msh", folder.path() / "bad.msh");
  }
  data.point_labels.assign(data.points.size(), 2);
  data.required_vertices = {3, 7};
  write(folder.path() / "good.meshb", data);
  check_damage(folder.path() / "good.meshb", folder.path() / "bad.meshb");
  data.required_vertices.clear();
  for (const Encoding& encoding : all_encodings()) {
    CAPTURE(static_cast<int>(encoding.coding));
    CAPTURE(encoding.is_packed);
    put_content(folder.path() / "good.vtu", VtuText(data, encoding).text());
    check_damage(folder.path() / "good.vtu", folder.path() / "bad.vtu");
  }
}

TEST_CASE(
    "what slices cannot know is read as a whole: hexahedra, several pieces, text without rows") {
  const Folder folder;
  pieces::OneRank one;
  MeshData data = lattice(2);
  data.required_vertices.clear();
  const std::filesystem::path msh = folder.path() / "mesh.msh";
  const auto is_sliced = [&](const std::filesystem::path& file) {
    const bool is_it = pieces::open_slices(file, {}, one) != nullptr;
    CHECK(pieces::InputMesh(file, one).tets() == data.tets.size());
    return is_it;
  };
  write(msh, data, "4.1 ASCII");
  CHECK(is_sliced(msh));
  std::string text = read_text(msh);
  text.insert(text.find("$EndNodes"), "\n");
  put_content(msh, text);
  CHECK(is_sliced(msh));  // a blank line behind all rows
  std::size_t row = text.find("$Nodes");
  for (int i = 0; i < 4; ++i) row = text.find('\n', row + 1);
  put_content(msh, text.replace(row, 1, " "));  // two numbers of nodes on one line
  CHECK(!is_sliced(msh));
  write(msh, data, "2.2 binary");
  CHECK(!is_sliced(msh));
  data.point_data.push_back({"height", 1, std::vector<double>(data.points.size(), 1.5)});
  write(msh, data, "4.1 binary");
  CHECK(!is_sliced(msh));
  const std::filesystem::path vtu = folder.path() / "mesh.vtu";
  write(vtu, data);
  CHECK(is_sliced(vtu));
  data.other_elements.push_back({12, 8, {0, 1, 4, 3, 9, 10, 13, 12}, {0}, {}, {}, {}});
  write(vtu, data);
  CHECK(!is_sliced(vtu));
}

TEST_CASE("files that are read by slices are improved as with all of them in memory") {
  const Folder folder;
  MeshData data = lattice(8);
  data.required_vertices.clear();
  write(folder.path() / "in.vtu", data);
  write(folder.path() / "in.msh", data);
  split_into_parts(data);
  write(folder.path() / "parts.msh", data);
  for (const std::string ending : {".msh", ".vtu", ".meshb"}) {
    check_improved(folder.path() / "in.msh", ending);
    check_improved(folder.path() / "parts.msh", ending);
    check_improved(folder.path() / "in.vtu", ending);
  }
}

TEST_CASE("what is lost of a file that is read by slices is told as of one in memory") {
  const Folder folder;
  MeshData data = mixed();
  data.groups.push_back({.dimension = 3, .number = 1, .name = "below", .parts = {}, .members = {}});
  data.tet_data.push_back({"weight", 1, std::vector<double>(data.tets.size(), 2.5)});
  write(folder.path() / "in.vtu", data);
  data.tet_data.clear();
  data.point_labels.clear();
  write(folder.path() / "in.msh", data);
  pieces::OneRank one;
  for (const std::string in : {"in.vtu", "in.msh"}) {
    const std::filesystem::path file = folder.path() / in;
    REQUIRE(pieces::open_slices(file, {}, one) != nullptr);
    for (const std::string out :
         {"o.meshb", "o.vtu", "o.msh", "o.su2", "o.vol", "o.bdf", "o.inp"}) {
      CAPTURE(in);
      CAPTURE(out);
      const MeshData all = read_mesh(file);
      std::vector<std::string> expected = all.notes;
      for (const std::string& text : not_written(out, all)) expected.push_back(text);
      CHECK(pieces::InputMesh(file, one).lost_in(out) == expected);
    }
  }
}

TEST_CASE("elements with a vertex twice are dropped by ranks and slices as with all in memory") {
  const Folder folder;
  MeshData data = lattice(4);
  data.required_vertices.clear();
  const auto v = data.tets[7].vertices;
  data.tets.insert(data.tets.begin() + 100, {{v[0], v[1], v[0], v[3]}, 0});
  data.triangles.push_back({{v[0], v[0], v[1]}, 0});
  for (const std::string name : {"in.meshb", "in.vtu", "in.msh"}) {
    CAPTURE(name);
    const std::filesystem::path file = folder.path() / name;
    write(file, data);
    const MeshData whole = read_mesh(file);
    REQUIRE(whole.tets.size() == data.tets.size() - 1);
    pieces::OneRank one;
    const pieces::InputMesh input(file, one);
    CHECK(input.tets() == whole.tets.size());
    const std::vector<std::string> told = input.lost_in("out.vtu");
    CHECK(std::includes(told.begin(), told.end(), whole.notes.begin(), whole.notes.end()));
    check_improved(file, ".vtu");
  }
}
