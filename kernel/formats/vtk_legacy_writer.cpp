// SPDX-License-Identifier: MIT
// Writes legacy VTK files with an unstructured grid, in binary and in the layout of version 4.2.
#include <bit>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/byte_reader.h"
#include "kernel/formats/output_file.h"
#include "kernel/formats/vtk_legacy.h"

namespace tetmend::formats {
namespace {

template <class T>
void put_big_endian(OutputFile& out, T value) {
  out.put_bytes(std::endian::native == std::endian::little ? byte_swapped(value) : value);
}

template <class Element>
void write_cells(OutputFile& out, const std::vector<Element>& elements) {
  for (const Element& element : elements) {
    put_big_endian(out, static_cast<std::int32_t>(element.vertices.size()));
    for (const std::uint32_t vertex : element.vertices) {
      put_big_endian(out, static_cast<std::int32_t>(vertex));
    }
  }
}

template <class Element>
void write_labels(OutputFile& out, const std::vector<Element>& elements) {
  for (const Element& element : elements) put_big_endian(out, element.label);
}

void write_types(OutputFile& out, std::size_t count, std::int32_t type) {
  for (std::size_t i = 0; i < count; ++i) put_big_endian(out, type);
}

constexpr std::string_view kLabelArray = "SCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n";

void write_mesh_data(OutputFile& out, const MeshData& mesh) {
  out.put("# vtk DataFile Version 3.0\nwritten by tetmend\nBINARY\nDATASET UNSTRUCTURED_GRID\n");
  out.put(fmt::format("POINTS {} double\n", mesh.points.size()));
  for (const Point& point : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) put_big_endian(out, point[axis]);
  }
  const std::size_t cells = mesh.tets.size() + mesh.triangles.size() + mesh.edges.size();
  const std::size_t integers =
      5 * mesh.tets.size() + 4 * mesh.triangles.size() + 3 * mesh.edges.size();
  out.put(fmt::format("\nCELLS {} {}\n", cells, integers));
  write_cells(out, mesh.tets);
  write_cells(out, mesh.triangles);
  write_cells(out, mesh.edges);
  out.put(fmt::format("\nCELL_TYPES {}\n", cells));
  write_types(out, mesh.tets.size(), 10);
  write_types(out, mesh.triangles.size(), 5);
  write_types(out, mesh.edges.size(), 3);
  out.put(fmt::format("\nCELL_DATA {}\n{}", cells, kLabelArray));
  write_labels(out, mesh.tets);
  write_labels(out, mesh.triangles);
  write_labels(out, mesh.edges);
  if (!mesh.point_labels.empty()) {
    out.put(fmt::format("\nPOINT_DATA {}\n{}", mesh.points.size(), kLabelArray));
    for (const Label label : mesh.point_labels) put_big_endian(out, label);
  }
  out.put("\n");
}

}  // namespace

void write_vtk_legacy(const std::filesystem::path& file, const MeshData& mesh) {
  if (mesh.points.size() > INT32_MAX) {
    throw Error(
        fmt::format("{}: cannot be written: the format holds at most {} vertices, the mesh has {}",
                    file.string(), INT32_MAX, mesh.points.size()));
  }
  OutputFile out(file);
  write_mesh_data(out, mesh);
  out.commit();
}

}  // namespace tetmend::formats
