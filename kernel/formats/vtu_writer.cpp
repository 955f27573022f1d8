// SPDX-License-Identifier: MIT
// Writes VTK's XML files: inline base64, in blocks of zlib.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/base64.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/vtu.h"
#include "kernel/formats/vtu_array.h"

namespace tetmend::formats {
namespace {

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

class Writer {
 public:
  Writer(OutputFile& out, const MeshView& mesh)
      : out_(out), mesh_(mesh), rest_(mesh.data() != nullptr ? *mesh.data() : kNothingElse) {}

  void write() {
    collect_cells();
    out_.put(vtu_head(mesh_.point_count(), types_.size()));
    write_point_data();
    write_cell_data();
    write_points();
    out_.put("<Cells>\n");
    write_array("connectivity", "Int64", 1, bytes_of(connectivity_));
    write_array("offsets", "Int64", 1, bytes_of(offsets_));
    write_array("types", "UInt8", 1, bytes_of(types_));
    out_.put("</Cells>\n");
    out_.put(kVtuEnd);
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
    std::visit(
        [&](const auto& values) {
          write_array(array.name, vtu_type_of(array), array.components, bytes_of(values));
        },
        array.values);
  }

  /// The header of the blocks is a base64 stream of its own.
  void write_array(std::string_view name, std::string_view type, std::size_t components,
                   std::string_view bytes) {
    out_.put(vtu_array_tag(name, type, components));
    VtuBlocks blocks;
    std::string packed;
    const auto take = [&](std::string_view block) { packed += block; };
    blocks.put(bytes, take);
    blocks.finish(take);
    out_.put(encode_base64(bytes_of(blocks.header())));
    out_.put(encode_base64(packed));
    out_.put(kVtuArrayEnd);
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
  out.commit(mesh.companions());
}

}  // namespace tetmend::formats
