// SPDX-License-Identifier: MIT
// MEDIT's text format `.mesh` (also known as GMF: Gamma Mesh Format).
#pragma once

#include <filesystem>

#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// Keeps Vertices, Edges, Triangles, Tetrahedra and RequiredVertices with their references, in any
/// order of sections; other sections of the format are passed over. The last `End` may be missing
/// (libigl writes none). @throws Error
MeshData read_medit_ascii(const std::filesystem::path& file, TetPlace* question = nullptr);

/// Tetrahedra come last, so that a file cut short never passes for a complete one. @throws Error
void write_medit_ascii(const std::filesystem::path& file, const MeshView& mesh);

}  // namespace tetmend::formats
