// SPDX-License-Identifier: MIT
// The cells of a legacy VTK file, and how they become elements of a mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/tet_place.h"
#include "kernel/formats/text_reader.h"
#include "kernel/formats/vtk_array.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Cells as the file has them, in one of two layouts. They are looked at when all is read, for
/// their types stand behind their vertices.
struct VtkCells {
  std::size_t count = 0;
  bool has_offsets = false;
  /// Since version 5: the vertices of cell i are connectivity[offsets[i]] to [offsets[i + 1] - 1].
  VtkIntegers offsets;
  /// Before version 5: for each cell the number of its vertices, then these.
  VtkIntegers connectivity;
  VtkIntegers types;

  /// Adds all cells to `mesh`, which has its points; labels are 0. Says in its notes which cells it
  /// cannot hold.
  /// @throws Error (through `text`) for vertices out of range or repeated, wrong sizes and volumes
  /// that cannot be kept
  CellNumbers append_to(MeshData& mesh, TextReader& text, TetPlace* question) const;
};

}  // namespace tetmend::formats
