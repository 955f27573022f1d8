// SPDX-License-Identifier: MIT
// Gmsh's files `.msh` of version 4.1 from the pieces of a mesh.
#pragma once

#include <filesystem>

#include "pieces/carried_rows.h"
#include "pieces/divided_mesh.h"
#include "pieces/gmsh_slices.h"

namespace tetmend::pieces {

/// What the file that was read has besides its mesh: see GmshSlices::has_all_in_rows().
struct CarriedEntities {
  const CarriedRows& rows;
  const GmshExtras& extras;
};

/// All ranks: the first writes the stored pieces to a `.msh` file of version 4.1, byte for byte as
/// write_mesh() writes what join() gives. It holds 4 bytes for each vertex, some 50 MB and what two
/// pieces take.
/// @param carried  null: each label is an entity
/// @throws Error as write_mesh().
void write_gmsh_slices(const std::filesystem::path& file, const DividedMesh& mesh, bool binary,
                       const CarriedEntities* carried = nullptr);

}  // namespace tetmend::pieces
