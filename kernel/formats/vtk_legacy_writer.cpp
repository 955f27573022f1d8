// SPDX-License-Identifier: MIT
// Writes legacy VTK files with an unstructured grid, in binary and in the layout of version 4.2.
#include <array>
#include <bit>
#include <span>
#include <string>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/byte_reader.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/vtk_legacy.h"

namespace tetmend::formats {
namespace {

template <class T>
void put_big_endian(OutputBuffer& out, T value) {
  out.put_bytes(std::endian::native == std::endian::little ? byte_swapped(value) : value);
}

template <class Element>
void put_cell(OutputBuffer& out, const Element& element) {
  put_big_endian(out, static_cast<std::int32_t>(element.vertices.size()));
  for (const std::uint32_t vertex : element.vertices) {
    put_big_endian(out, static_cast<std::int32_t>(vertex));
  }
}

template <class Element>
void write_cells(OutputFile& out, std::span<const Element> elements) {
  put_rows(out, elements.size(),
           [&](std::size_t i, OutputBuffer& buffer) { put_cell(buffer, elements[i]); });
}

template <class Element>
void write_labels(OutputFile& out, std::span<const Element> elements) {
  put_rows(out, elements.size(),
           [&](std::size_t i, OutputBuffer& buffer) { put_big_endian(buffer, elements[i].label); });
}

void write_types(OutputFile& out, std::size_t count, std::int32_t type) {
  put_rows(out, count, [&](std::size_t, OutputBuffer& buffer) { put_big_endian(buffer, type); });
}

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

std::string_view type_name(const DataArray& array) {
  constexpr std::array<std::string_view, 4> kNames = {"int", "vtktypeint64", "float", "double"};
  return kNames[array.values.index()];
}

void write_arrays(OutputFile& out, const std::vector<DataArray>& arrays) {
  if (arrays.empty()) return;
  out.put(fmt::format("\nFIELD FieldData {}\n", arrays.size()));
  for (const DataArray& array : arrays) {
    out.put(fmt::format("{} {} {} {}\n", encoded(array.name), array.components,
                        array.size() / array.components, type_name(array)));
    std::visit(
        [&out](const auto& values) {
          put_rows(out, values.size(),
                   [&](std::size_t i, OutputBuffer& buffer) { put_big_endian(buffer, values[i]); });
        },
        array.values);
    out.put("\n");
  }
}

void write_other_cells(OutputFile& out, const OtherElements& others) {
  put_rows(out, others.labels.size(), [&](std::size_t i, OutputBuffer& buffer) {
    put_big_endian(buffer, static_cast<std::int32_t>(others.vertex_count));
    for (std::size_t k = 0; k < others.vertex_count; ++k) {
      put_big_endian(buffer,
                     static_cast<std::int32_t>(others.vertices[i * others.vertex_count + k]));
    }
  });
}

void write_field(OutputFile& out, const TetField& field, std::size_t other_cells) {
  out.put(fmt::format("SCALARS {} int 1\nLOOKUP_TABLE default\n", field.name));
  put_rows(out, field.values.size(),
           [&](std::size_t i, OutputBuffer& buffer) { put_big_endian(buffer, field.values[i]); });
  put_rows(out, other_cells,
           [](std::size_t, OutputBuffer& buffer) { put_big_endian(buffer, std::int32_t{0}); });
}

void write_view(OutputFile& out, const MeshView& mesh, std::span<const TetField> fields) {
  out.put("# vtk DataFile Version 3.0\nwritten by tetmend\nBINARY\nDATASET UNSTRUCTURED_GRID\n");
  out.put(fmt::format("POINTS {} double\n", mesh.point_count()));
  put_rows(out, mesh.point_count(), [&](std::size_t i, OutputBuffer& buffer) {
    for (int axis = 0; axis < 3; ++axis) put_big_endian(buffer, mesh.point(i)[axis]);
  });
  const std::size_t tets = mesh.tet_count();
  const std::size_t triangles = mesh.triangles().size();
  const std::size_t edges = mesh.edges().size();
  static const MeshData kNothingElse;
  const MeshData& rest = mesh.data() != nullptr ? *mesh.data() : kNothingElse;
  std::size_t cells = tets + triangles + edges;
  std::size_t integers = 5 * tets + 4 * triangles + 3 * edges;
  for (const OtherElements& others : rest.other_elements) {
    cells += others.labels.size();
    integers += others.labels.size() * (others.vertex_count + 1);
  }
  out.put(fmt::format("\nCELLS {} {}\n", cells, integers));
  put_tets(out, mesh, [](std::size_t, const MeshData::Tet& tet, OutputBuffer& buffer) {
    put_cell(buffer, tet);
  });
  write_cells(out, mesh.triangles());
  write_cells(out, mesh.edges());
  for (const OtherElements& others : rest.other_elements) write_other_cells(out, others);
  out.put(fmt::format("\nCELL_TYPES {}\n", cells));
  write_types(out, tets, 10);
  write_types(out, triangles, 5);
  write_types(out, edges, 3);
  for (const OtherElements& others : rest.other_elements) {
    write_types(out, others.labels.size(), others.vtk_type);
  }
  out.put(fmt::format("\nCELL_DATA {}\n{}", cells, label_array(rest.label_array)));
  put_tets(out, mesh, [](std::size_t, const MeshData::Tet& tet, OutputBuffer& buffer) {
    put_big_endian(buffer, tet.label);
  });
  write_labels(out, mesh.triangles());
  write_labels(out, mesh.edges());
  for (const OtherElements& others : rest.other_elements) {
    put_rows(out, others.labels.size(), [&](std::size_t i, OutputBuffer& buffer) {
      put_big_endian(buffer, others.labels[i]);
    });
  }
  for (const TetField& field : fields) {
    out.put("\n");
    write_field(out, field, cells - tets);
  }
  write_arrays(out, join_cell_arrays(rest));
  if (mesh.has_point_labels() || !rest.point_data.empty()) {
    out.put(fmt::format("\nPOINT_DATA {}\n", mesh.point_count()));
  }
  if (mesh.has_point_labels()) {
    out.put(label_array({}));
    put_rows(out, mesh.point_count(), [&](std::size_t i, OutputBuffer& buffer) {
      put_big_endian(buffer, mesh.point_label(i));
    });
  }
  write_arrays(out, rest.point_data);
  out.put("\n");
}

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
  write_view(out, mesh, fields);
  out.commit(mesh.companions());
}

}  // namespace tetmend::formats
