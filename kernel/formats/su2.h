// SPDX-License-Identifier: MIT
// The native format `.su2` of the flow solver SU2, for meshes in space.
#pragma once

#include <filesystem>
#include <string_view>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh: its deck is ours.
inline constexpr std::string_view kSu2 = "SU2";

/// Which kinds of elements it has: all of element_kind() in space and on surfaces.
inline bool su2_holds(int vtk_type) {
  const ElementKind* kind = element_kind(vtk_type);
  return kind != nullptr && kind->dimension >= 2;
}

/// Markers become named groups of triangles and quadrilaterals, with the labels 1, 2, 3... in their
/// order, or with their tags for labels where all of these are integers. Keywords that say nothing
/// of the mesh stay word for word. @throws Error
MeshData read_su2(const std::filesystem::path& file, TetPlace* question = nullptr);

/// Writes a marker for each label of triangles and quadrilaterals, under the name of its group or
/// else under its number. @throws Error
void write_su2(const std::filesystem::path& file, const MeshView& mesh);

}  // namespace tetmend::formats
