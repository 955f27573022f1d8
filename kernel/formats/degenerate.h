// SPDX-License-Identifier: MIT
// Elements that no mesh can have: with a vertex twice, or listed a second time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Takes out of a mesh tets, triangles and edges, of first or second order, that have a corner
/// twice: their content is 0 wherever their vertices lie. And tets with the corners of an earlier
/// one. A note names them. Other elements stay: a hexahedron may be collapsed to a prism.
/// Precondition: the corners are points; those of second order are among the other elements.
/// @param place_of  where in the file an element stands that goes, by its dimension and its number
/// among tets, triangles or edges; empty: not known. Asked for the first of each note.
/// @return the numbers of the tets that went, ascending: of MeshData::tets or, where there are none, of
/// those of second order
/// Cost: linear; 32 bytes a point and 1 a tet meanwhile.
std::vector<std::uint32_t> drop_degenerate(
    MeshData& mesh,
    const std::function<std::string(int dimension, std::size_t number)>& place_of = {});

/// True for such a note: of a mesh that is only measured, other notes are of no account.
inline bool tells_of_dropped(std::string_view note) {
  return note.ends_with(": dropped");
}

}  // namespace tetmend::formats
