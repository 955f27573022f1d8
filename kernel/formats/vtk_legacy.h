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

/// ASCII and binary files of version 1.0 to 5.1. Keeps cells of all kinds but polyhedra and volumes
/// of higher order, which are errors, and all arrays of numbers of cells and points. Labels come
/// from one of them, see adopt_cell_arrays(). @throws Error
MeshData read_vtk_legacy(const std::filesystem::path& file, const ReadRequest& request = {});

/// One whole number for each tet, in the order of the mesh.
struct TetField {
  std::string_view name;  ///< without blanks
  std::span<const std::int32_t> values;
};

/// Binary, in the layout of version 4.2 that also old readers take. Labels go to the cell array that
/// they came from, or to CellEntityIds, as Gmsh has it; those of points to CellEntityIds. Other
/// arrays follow. Required vertices and groups have no place in the format. The format has no end mark: of a file cut exactly before its labels nothing
/// tells that they are missing. @throws Error also for more than 2^31 - 1 vertices
void write_vtk_legacy(const std::filesystem::path& file, const MeshView& mesh);
/// With further cell arrays, in which triangles and edges have 0.
void write_vtk_legacy(const std::filesystem::path& file, const MeshView& mesh,
                      std::span<const TetField> fields);

}  // namespace tetmend::formats
