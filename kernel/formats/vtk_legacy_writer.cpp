// SPDX-License-Identifier: MIT
// Writes legacy VTK files with an unstructured grid, in the layout of version 4.2.
#include <algorithm>
#include <array>
#include <bit>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/byte_reader.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/vtk_legacy.h"
#include "kernel/formats/vtk_roles.h"

namespace tetmend::formats {
namespace {

/// A number as bytes, or as text with a blank behind it.
class Coding {
 public:
  explicit Coding(bool is_text) : is_text_(is_text) {}

  template <class Value>
  void put(OutputBuffer& out, Value value) const {
    if (is_text_) {
      put_number(out, value);
      out.put(' ');
    } else {
      out.put_bytes(std::endian::native == std::endian::little ? byte_swapped(value) : value);
    }
  }
  void end_row(OutputBuffer& out) const {
    if (is_text_) out.put('\n');
  }
  /// Of a list: one number.
  template <class Value>
  void put_row(OutputBuffer& out, Value value) const {
    put(out, value);
    end_row(out);
  }

 private:
  bool is_text_;
};

/// Names have no blanks in the format.
std::string encoded(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (static_cast<unsigned char>(c) <= ' ' || c == '%' || c == '"') {
      text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    } else {
      text += c;
    }
  }
  return text.empty() ? "unnamed" : text;
}

std::string label_array(std::string_view name) {
  return fmt::format("SCALARS {} int 1\nLOOKUP_TABLE default\n",
                     name.empty() ? "CellEntityIds" : encoded(name));
}

/// Those that a file of version 3.0 has. Elsewhere than on Windows a long has 8 bytes.
std::string_view type_name(const DataArray& array) {
  constexpr std::array<std::string_view, 4> kNames = {"int", "long", "float", "double"};
  return kNames[array.values.index()];
}

/// One call of write_vtk_legacy().
class VtkLegacyWriter {
 public:
  VtkLegacyWriter(OutputFile& out, const MeshView& mesh)
      : out_(out),
        mesh_(mesh),
        rest_(mesh.data() != nullptr ? *mesh.data() : kNothingElse),
        is_text_(mesh.variant() == kVtkAscii),
        coding_(is_text_),
        roles_(roles_of(rest_)),
        tets_(mesh.tet_count()),
        cells_(tets_ + mesh.triangles().size() + mesh.edges().size()) {
    for (const OtherElements& others : rest_.other_elements) cells_ += others.labels.size();
  }

  void write(std::span<const TetField> fields) {
    out_.put(fmt::format(
        "# vtk DataFile Version 3.0\nwritten by tetmend\n{}\nDATASET UNSTRUCTURED_GRID\n",
        is_text_ ? "ASCII" : "BINARY"));
    write_points();
    write_cells();
    write_types();
    write_cell_data(fields);
    write_point_data();
    out_.put("\n");
  }

 private:
  inline static const MeshData kNothingElse;

  void write_points() {
    out_.put(fmt::format("POINTS {} double\n", mesh_.point_count()));
    put_rows(out_, mesh_.point_count(), [&](std::size_t i, OutputBuffer& buffer) {
      for (int axis = 0; axis < 3; ++axis) coding_.put(buffer, mesh_.point(i)[axis]);
      coding_.end_row(buffer);
    });
  }

  void write_cells() {
    std::size_t integers = 5 * tets_ + 4 * mesh_.triangles().size() + 3 * mesh_.edges().size();
    for (const OtherElements& others : rest_.other_elements) {
      integers += others.labels.size() * (others.vertex_count + 1);
    }
    out_.put(fmt::format("\nCELLS {} {}\n", cells_, integers));
    put_tets(out_, mesh_, [this](std::size_t, const MeshData::Tet& tet, OutputBuffer& buffer) {
      put_cell(buffer, tet.vertices);
    });
    const auto write = [this](const auto& elements) {
      put_rows(out_, elements.size(), [&](std::size_t i, OutputBuffer& buffer) {
        put_cell(buffer, elements[i].vertices);
      });
    };
    write(mesh_.triangles());
    write(mesh_.edges());
    for (const OtherElements& others : rest_.other_elements) {
      put_rows(out_, others.labels.size(), [&](std::size_t i, OutputBuffer& buffer) {
        put_cell(buffer,
                 std::span(others.vertices).subspan(i * others.vertex_count, others.vertex_count));
      });
    }
  }
  void put_cell(OutputBuffer& buffer, std::span<const std::uint32_t> vertices) const {
    coding_.put(buffer, static_cast<std::int32_t>(vertices.size()));
    for (const std::uint32_t vertex : vertices) {
      coding_.put(buffer, static_cast<std::int32_t>(vertex));
    }
    coding_.end_row(buffer);
  }

  void write_types() {
    out_.put(fmt::format("\nCELL_TYPES {}\n", cells_));
    const auto write = [this](std::size_t count, std::int32_t type) {
      put_rows(out_, count,
               [&](std::size_t, OutputBuffer& buffer) { coding_.put_row(buffer, type); });
    };
    write(tets_, 10);
    write(mesh_.triangles().size(), 5);
    write(mesh_.edges().size(), 3);
    for (const OtherElements& others : rest_.other_elements) {
      write(others.labels.size(), others.vtk_type);
    }
  }

  void write_cell_data(std::span<const TetField> fields) {
    out_.put(fmt::format("\nCELL_DATA {}\n{}", cells_, label_array(rest_.label_array)));
    put_tets(out_, mesh_, [this](std::size_t, const MeshData::Tet& tet, OutputBuffer& buffer) {
      coding_.put_row(buffer, tet.label);
    });
    const auto write = [this](std::size_t count, const auto& label) {
      put_rows(out_, count,
               [&](std::size_t i, OutputBuffer& buffer) { coding_.put_row(buffer, label(i)); });
    };
    const auto triangles = mesh_.triangles();
    write(triangles.size(), [&](std::size_t i) { return triangles[i].label; });
    const auto edges = mesh_.edges();
    write(edges.size(), [&](std::size_t i) { return edges[i].label; });
    for (const OtherElements& others : rest_.other_elements) {
      write(others.labels.size(), [&](std::size_t i) { return others.labels[i]; });
    }
    for (const TetField& field : fields) {
      out_.put(fmt::format("\nSCALARS {} int 1\nLOOKUP_TABLE default\n", field.name));
      write(field.values.size(), [&](std::size_t i) { return field.values[i]; });
      write(cells_ - tets_, [](std::size_t) { return std::int32_t{0}; });
    }
    write_arrays(join_cell_arrays(rest_), false);
  }

  void write_point_data() {
    if (mesh_.has_point_labels() || !rest_.point_data.empty()) {
      out_.put(fmt::format("\nPOINT_DATA {}\n", mesh_.point_count()));
    }
    if (mesh_.has_point_labels()) {
      out_.put(label_array({}));
      put_rows(out_, mesh_.point_count(), [this](std::size_t i, OutputBuffer& buffer) {
        coding_.put_row(buffer, mesh_.point_label(i));
      });
    }
    write_arrays(rest_.point_data, true);
  }

  /// Those with a role that the format has a keyword for, then the others in one field.
  void write_arrays(const std::vector<DataArray>& arrays, bool of_points) {
    std::vector<const DataArray*> others;
    std::set<std::string> written;  // keywords
    for (const DataArray& array : arrays) {
      const std::string keyword = keyword_of(array, of_points);
      if (keyword.empty() || !written.insert(keyword).second) {
        others.push_back(&array);
        continue;
      }
      const std::string_view type = keyword == "NORMALS" ? type_name(array) : "vtkIdType";
      out_.put(fmt::format("\n{} {} {}\n", keyword, encoded(array.name), type));
      write_values(array, keyword != "NORMALS");
    }
    if (others.empty()) return;
    out_.put(fmt::format("\nFIELD FieldData {}\n", others.size()));
    for (const DataArray* array : others) {
      out_.put(fmt::format("{} {} {} {}\n", encoded(array->name), array->components,
                           array->size() / array->components, type_name(*array)));
      write_values(*array, false);
      out_.put("\n");
    }
  }
  /// Empty where the format has none for it. Its vtkIdType has 4 bytes.
  std::string keyword_of(const DataArray& array, bool of_points) const {
    for (const VtkRole& role : roles_) {
      if (role.of_points != of_points || role.array != array.name) continue;
      if (role.role == "Normals" && array.components == 3 && array.values.index() >= 2) {
        return "NORMALS";
      }
      if (is_id_role(role.role) && array.components == 1 && fits_int32(array)) {
        return role.role == "GlobalIds" ? "GLOBAL_IDS" : "PEDIGREE_IDS";
      }
    }
    return {};
  }
  static bool fits_int32(const DataArray& array) {
    const auto* wide = std::get_if<std::vector<std::int64_t>>(&array.values);
    if (wide == nullptr) return array.values.index() == 0;
    return std::all_of(wide->begin(), wide->end(),
                       [](std::int64_t v) { return v >= INT32_MIN && v <= INT32_MAX; });
  }
  void write_values(const DataArray& array, bool as_ids) {
    const std::size_t components = array.components;
    std::visit(
        [&](const auto& values) {
          put_rows(out_, values.size(), [&](std::size_t i, OutputBuffer& buffer) {
            as_ids ? coding_.put(buffer, static_cast<std::int32_t>(values[i]))
                   : coding_.put(buffer, values[i]);
            if ((i + 1) % components == 0) coding_.end_row(buffer);
          });
        },
        array.values);
  }

  OutputFile& out_;
  const MeshView& mesh_;
  const MeshData& rest_;
  const bool is_text_;
  const Coding coding_;
  const std::vector<VtkRole> roles_;
  const std::size_t tets_;
  std::size_t cells_;
};

}  // namespace

void write_vtk_legacy(const std::filesystem::path& file, const MeshView& mesh) {
  write_vtk_legacy(file, mesh, {});
}

void write_vtk_legacy(const std::filesystem::path& file, const MeshView& mesh,
                      std::span<const TetField> fields) {
  if (mesh.point_count() > INT32_MAX) {
    throw Error(
        fmt::format("{}: cannot be written: the format holds at most {} vertices, the mesh has {}",
                    file.string(), INT32_MAX, mesh.point_count()));
  }
  OutputFile out(file);
  VtkLegacyWriter(out, mesh).write(fields);
  out.commit(mesh.companions());
}

}  // namespace tetmend::formats
