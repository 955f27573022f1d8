// SPDX-License-Identifier: MIT
// VTK's XML files `.vtu` from the pieces of a mesh.
#pragma once

#include <filesystem>
#include <string>

#include "pieces/carried_rows.h"
#include "pieces/divided_mesh.h"

namespace tetmend::pieces {

/// What a file has besides its mesh.
struct VtuExtras {
  const CarriedRows* rows = nullptr;  ///< null: no arrays
  std::string label_array = {};       ///< see MeshData::label_array
};

/// All ranks: the first writes the stored pieces to a `.vtu` file, byte for byte as write_mesh() writes
/// what join() gives, and holds some 30 MB and what two pieces take. Everything is packed twice.
/// @throws Error as write_mesh().
void write_vtu_slices(const std::filesystem::path& file, const DividedMesh& mesh,
                      const VtuExtras& extras = {});

}  // namespace tetmend::pieces
