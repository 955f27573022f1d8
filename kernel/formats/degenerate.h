// SPDX-License-Identifier: MIT
// Elements that no mesh can have: with a vertex twice, or listed a second time.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Takes out of a mesh tets, triangles and edges, of first or second order, that have a corner
/// twice: their content is 0 wherever their vertices lie. And tets with the corners of an earlier
/// one. A note names them. Other elements stay: a hexahedron may be collapsed to a prism.
/// Precondition: the corners are points; those of second order are among the other elements.
/// @return the numbers of those of MeshData::tets that went, ascending
/// Cost: linear; 12 bytes a tet meanwhile.
std::vector<std::uint32_t> drop_degenerate(MeshData& mesh);

/// True for such a note: of a mesh that is only measured, other notes are of no account.
inline bool tells_of_dropped(std::string_view note) {
  return note.ends_with(": dropped");
}

}  // namespace tetmend::formats
