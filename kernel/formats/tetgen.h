// SPDX-License-Identifier: MIT
// TetGen's files `.node`, `.ele`, `.face` and `.edge`: one mesh in up to four files of one stem.
#pragma once

#include <filesystem>
#include <string_view>

#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// Names of the arrays that hold attributes of vertices and tets begin so; a number follows.
inline constexpr std::string_view kTetgenArrays = "attribute";

/// MeshData::variant: what the first vertex is called, and the first element when it is written.
inline constexpr std::string_view kTetgenFromZero = "from 0";
inline constexpr std::string_view kTetgenFromOne = "from 1";

/// Reads `.node` and `.ele`, and `.face` and `.edge` where they exist beside them. Vertices count
/// from 0 or 1, as the first line of `.node` has it. The first attribute of a tet is its label,
/// rounded to an integer, the others are arrays; boundary markers are the labels of vertices, triangles and edges; a
/// missing column is 0. @throws Error
MeshData read_tetgen(const std::filesystem::path& node_or_ele, TetPlace* question = nullptr);

/// Writes `.node`, `.ele` and `.face`, counting from 0 unless the variant says 1. `.edge` is written when there are edges, or
/// when such a file exists: left from an older mesh it would be read back as a part of this one.
/// Required vertices have no place in the format. All files are complete under temporary names
/// before the first is renamed. @throws Error
void write_tetgen(const std::filesystem::path& node_or_ele, const MeshView& mesh);

/// All files of a mesh that is named by one of them, that one first.
std::vector<std::filesystem::path> tetgen_files(const std::filesystem::path& node_or_ele);

}  // namespace tetmend::formats
