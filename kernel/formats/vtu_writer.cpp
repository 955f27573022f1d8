// SPDX-License-Identifier: MIT
// Writes VTK's XML files: inline base64, in blocks of zlib.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/base64.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/compression.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/vtu.h"

namespace tetmend::formats {
namespace {

constexpr std::size_t kBlockSize = std::size_t{1} << 17;

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) < ' ')
      result += ' ';
    else
      result += c;
  }
  return result;
}

class Writer {
 public:
  Writer(OutputFile& out, const MeshView& mesh)
      : out_(out), mesh_(mesh), rest_(mesh.data() != nullptr ? *mesh.data() : kNothingElse) {}

  void write() {
    collect_cells();
    out_.put("<?xml version=\"1.0\"?>\n");
    out_.put(
        fmt::format("<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
                    "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n",
                    std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian"));
    out_.put(fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                         mesh_.point_count(), types_.size()));
    write_point_data();
    write_cell_data();
    write_points();
    out_.put("<Cells>\n");
    write_array("connectivity", "Int64", 1, bytes_of(connectivity_));
    write_array("offsets", "Int64", 1, bytes_of(offsets_));
    write_array("types", "UInt8", 1, bytes_of(types_));
    out_.put("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  }

 private:
  inline static const MeshData kNothingElse;

  void collect_cells() {
    std::vector<MeshData::Tet> memory;
    for (std::size_t block = 0; block < mesh_.tet_blocks(); ++block) {
      for (const MeshData::Tet& tet : mesh_.tets(block, memory)) add_cell(tet, 10);
    }
    for (const MeshData::Triangle& triangle : mesh_.triangles()) add_cell(triangle, 5);
    for (const MeshData::Edge& edge : mesh_.edges()) add_cell(edge, 3);
    for (const OtherElements& others : rest_.other_elements) {
      for (std::size_t i = 0; i < others.labels.size(); ++i) {
        const std::uint32_t* vertices = others.vertices.data() + i * others.vertex_count;
        end_cell(vertices, others.vertex_count, others.labels[i], others.vtk_type);
      }
    }
  }

  template <class Element>
  void add_cell(const Element& element, int type) {
    end_cell(element.vertices.data(), element.vertices.size(), element.label, type);
  }
  void end_cell(const std::uint32_t* vertices, std::size_t count, Label label, int type) {
    connectivity_.insert(connectivity_.end(), vertices, vertices + count);
    offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
    types_.push_back(static_cast<std::uint8_t>(type));
    labels_.push_back(label);
  }

  void write_point_data() {
    if (!mesh_.has_point_labels() && rest_.point_data.empty()) return;
    out_.put("<PointData>\n");
    if (mesh_.has_point_labels()) {
      std::vector<Label> labels(mesh_.point_count());
      for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = mesh_.point_label(i);
      write_array("CellEntityIds", "Int32", 1, bytes_of(labels));
    }
    for (const DataArray& array : rest_.point_data) write_array(array);
    out_.put("</PointData>\n");
  }

  void write_cell_data() {
    out_.put("<CellData>\n");
    const bool tell_apart =
        std::any_of(labels_.begin(), labels_.end(), [](Label l) { return l != 0; });
    if (tell_apart || !rest_.label_array.empty()) {
      write_array(rest_.label_array.empty() ? "CellEntityIds" : rest_.label_array, "Int32", 1,
                  bytes_of(labels_));
    }
    for (const DataArray& array : join_cell_arrays(rest_)) write_array(array);
    out_.put("</CellData>\n");
  }

  void write_points() {
    std::vector<double> numbers;
    numbers.reserve(3 * mesh_.point_count());
    for (std::size_t i = 0; i < mesh_.point_count(); ++i) {
      for (int axis = 0; axis < 3; ++axis) numbers.push_back(mesh_.point(i)[axis]);
    }
    out_.put("<Points>\n");
    write_array("Points", "Float64", 3, bytes_of(numbers));
    out_.put("</Points>\n");
  }

  void write_array(const DataArray& array) {
    constexpr std::array<std::string_view, 4> kTypes = {"Int32", "Int64", "Float32", "Float64"};
    std::visit(
        [&](const auto& values) {
          write_array(array.name, kTypes[array.values.index()], array.components, bytes_of(values));
        },
        array.values);
  }

  /// The header of the blocks is a base64 stream of its own.
  void write_array(std::string_view name, std::string_view type, std::size_t components,
                   std::string_view bytes) {
    out_.put(
        fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
                    "format=\"binary\">\n",
                    type, escaped(name), components));
    const std::size_t blocks = (bytes.size() + kBlockSize - 1) / kBlockSize;
    std::vector<std::uint64_t> header = {blocks, kBlockSize, bytes.size() % kBlockSize};
    std::string packed;
    for (std::size_t i = 0; i < blocks; ++i) {
      const std::string block = deflate_block(bytes.substr(i * kBlockSize, kBlockSize));
      header.push_back(block.size());
      packed += block;
    }
    out_.put(encode_base64(bytes_of(header)));
    out_.put(encode_base64(packed));
    out_.put("\n</DataArray>\n");
  }

  OutputFile& out_;
  const MeshView& mesh_;
  const MeshData& rest_;
  std::vector<std::int64_t> connectivity_;
  std::vector<std::int64_t> offsets_;
  std::vector<std::uint8_t> types_;
  std::vector<Label> labels_;
};

}  // namespace

void write_vtu(const std::filesystem::path& file, const MeshView& mesh) {
  OutputFile out(file);
  Writer(out, mesh).write();
  out.commit();
}

}  // namespace tetmend::formats
