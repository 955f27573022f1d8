// SPDX-License-Identifier: MIT
// VTK's XML files `.vtu` with an unstructured grid.
#pragma once

#include <filesystem>

#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// All encodings: ASCII, inline base64, appended base64 and appended raw; each plain or in blocks of
/// zlib; sizes of 32 or 64 bits; either byte order. Several pieces become one mesh. What is kept is
/// as in read_vtk_legacy(). @throws Error
MeshData read_vtu(const std::filesystem::path& file, const ReadRequest& request = {});

/// Inline base64 in blocks of zlib, which all readers understand. Labels and arrays as in
/// write_vtk_legacy(). @throws Error
void write_vtu(const std::filesystem::path& file, const MeshView& mesh);

}  // namespace tetmend::formats
