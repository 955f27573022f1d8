// SPDX-License-Identifier: MIT
// Legacy VTK files `.vtk` with an unstructured grid.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// ASCII and binary files of version 1.0 to 5.1. Keeps tetrahedra, triangles and lines; vertices,
/// quadrilaterals and other curves and surfaces are passed over; any other volume cell is an error.
/// Labels of cells and points come from the scalar array of integers whose name is one that mesh
/// tools use (`vtk_label_names` in the .cpp, best first). @throws Error
MeshData read_vtk_legacy(const std::filesystem::path& file, TetPlace* question = nullptr);

/// One whole number for each tet, in the order of the mesh.
struct TetField {
  std::string_view name;  ///< without blanks
  std::span<const std::int32_t> values;
};

/// Binary, in the layout of version 4.2 that also old readers take. Labels go to the cell array
/// CellEntityIds, as Gmsh has it, and to the point array of that name. Required vertices have no
/// place in the format. The format has no end mark: of a file cut exactly before its labels nothing
/// tells that they are missing. @throws Error also for more than 2^31 - 1 vertices
void write_vtk_legacy(const std::filesystem::path& file, const MeshView& mesh);
/// With further cell arrays, in which triangles and edges have 0.
void write_vtk_legacy(const std::filesystem::path& file, const MeshView& mesh,
                      std::span<const TetField> fields);

}  // namespace tetmend::formats
