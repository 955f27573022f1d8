// SPDX-License-Identifier: MIT
// Gmsh's files `.msh` of version 4.1 from the pieces of a mesh.
#pragma once

#include <filesystem>

#include "pieces/divided_mesh.h"

namespace tetmend::pieces {

/// All ranks: the first writes the stored pieces to a `.msh` file of version 4.1, byte for byte as
/// write_mesh() writes what join() gives. It holds 4 bytes for each vertex, some 50 MB and what two
/// pieces take.
/// @throws Error as write_mesh().
void write_gmsh_slices(const std::filesystem::path& file, const DividedMesh& mesh, bool binary);

}  // namespace tetmend::pieces
