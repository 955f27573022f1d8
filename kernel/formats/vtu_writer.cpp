// SPDX-License-Identifier: MIT
// Writes VTK's XML files: inline base64, in blocks of zlib; or text.
#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/base64.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/vtk_roles.h"
#include "kernel/formats/vtu.h"
#include "kernel/formats/vtu_array.h"

namespace tetmend::formats {
namespace {

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

class VtuWriter {
 public:
  VtuWriter(OutputFile& out, const MeshView& mesh)
      : out_(out),
        mesh_(mesh),
        rest_(mesh.data() != nullptr ? *mesh.data() : kNothingElse),
        is_text_(mesh.variant() == kVtkAscii),
        roles_(roles_of(rest_)) {}

  void write() {
    collect_cells();
    out_.put(vtu_head(mesh_.point_count(), types_.size()));
    write_point_data();
    write_cell_data();
    write_points();
    out_.put("<Cells>\n");
    write_values("connectivity", "Int64", 1, connectivity_);
    write_values("offsets", "Int64", 1, offsets_);
    write_values("types", "UInt8", 1, types_);
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
    std::set<std::string> names;
    for (const DataArray& array : rest_.point_data) names.insert(array.name);
    out_.put(data_tag("PointData", true, names));
    if (mesh_.has_point_labels()) {
      std::vector<Label> labels(mesh_.point_count());
      for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = mesh_.point_label(i);
      write_values("CellEntityIds", "Int32", 1, labels);
    }
    for (const DataArray& array : rest_.point_data) write_array(array, true);
    out_.put("</PointData>\n");
  }

  void write_cell_data() {
    const std::vector<DataArray> arrays = join_cell_arrays(rest_);
    std::set<std::string> names = {rest_.label_array};
    for (const DataArray& array : arrays) names.insert(array.name);
    out_.put(data_tag("CellData", false, names));
    const bool tell_apart =
        std::any_of(labels_.begin(), labels_.end(), [](Label l) { return l != 0; });
    if (tell_apart || !rest_.label_array.empty()) {
      write_values(rest_.label_array.empty() ? "CellEntityIds" : rest_.label_array, "Int32", 1,
                   labels_);
    }
    for (const DataArray& array : arrays) write_array(array, false);
    out_.put("</CellData>\n");
  }

  void write_points() {
    std::vector<double> numbers;
    numbers.reserve(3 * mesh_.point_count());
    for (std::size_t i = 0; i < mesh_.point_count(); ++i) {
      for (int axis = 0; axis < 3; ++axis) numbers.push_back(mesh_.point(i)[axis]);
    }
    out_.put("<Points>\n");
    write_values("Points", "Float64", 3, numbers);
    out_.put("</Points>\n");
  }

  /// With the roles of arrays that are there.
  std::string data_tag(std::string_view tag, bool of_points, const std::set<std::string>& names) {
    std::string text = fmt::format("<{}", tag);
    for (const VtkRole& role : roles_) {
      if (role.of_points != of_points || !names.contains(role.array)) continue;
      text += fmt::format(" {}=\"{}\"", role.role, xml_escaped(role.array));
    }
    return text + ">\n";
  }
  bool has_id_role(const DataArray& array, bool of_points) const {
    return std::any_of(roles_.begin(), roles_.end(), [&](const VtkRole& role) {
      return is_id_role(role.role) && role.of_points == of_points && role.array == array.name;
    });
  }

  void write_array(const DataArray& array, bool of_points) {
    const bool is_id = array.values.index() == 1 && has_id_role(array, of_points);
    std::visit(
        [&](const auto& values) {
          write_values(array.name, vtu_type_of(array), array.components, values, is_id);
        },
        array.values);
  }

  template <class Value>
  void write_values(std::string_view name, std::string_view type, std::size_t components,
                    const std::vector<Value>& values, bool is_id = false) {
    out_.put(vtu_array_tag(name, type, components, is_text_, is_id));
    if (is_text_) {
      write_text(values, components);
    } else {
      write_packed(bytes_of(values));
    }
    out_.put(kVtuArrayEnd);
  }

  template <class Value>
  void write_text(const std::vector<Value>& values, std::size_t components) {
    put_rows(out_, values.size(), [&](std::size_t i, OutputBuffer& buffer) {
      put_number(buffer, values[i]);
      buffer.put((i + 1) % components == 0 ? '\n' : ' ');
    });
  }

  /// The header of the blocks is a base64 stream of its own.
  void write_packed(std::string_view bytes) {
    VtuBlocks blocks;
    std::string packed;
    const auto take = [&](std::string_view block) { packed += block; };
    blocks.put(bytes, take);
    blocks.finish(take);
    out_.put(encode_base64(bytes_of(blocks.header())));
    out_.put(encode_base64(packed));
  }

  OutputFile& out_;
  const MeshView& mesh_;
  const MeshData& rest_;
  const bool is_text_;
  const std::vector<VtkRole> roles_;
  std::vector<std::int64_t> connectivity_;
  std::vector<std::int64_t> offsets_;
  std::vector<std::uint8_t> types_;
  std::vector<Label> labels_;
};

}  // namespace

void write_vtu(const std::filesystem::path& file, const MeshView& mesh) {
  OutputFile out(file);
  VtuWriter(out, mesh).write();
  out.commit(mesh.companions());
}

}  // namespace tetmend::formats
