// SPDX-License-Identifier: MIT
// Which volume elements lie on the two sides of a triangle or quadrilateral.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/formats/element_rows.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

inline constexpr std::uint32_t kNoElement = UINT32_MAX;

/// Volume elements count from 0 through all lists of dimension 3, in their order.
struct FaceSides {
  std::uint32_t behind = kNoElement;  ///< the normal points out of this one
  std::uint32_t front = kNoElement;
};

/// Of each element of each list of dimension 2. The orientation of tets is looked at; other volumes
/// are taken to be as VTK has them. Time is linear in the size of the mesh.
std::vector<std::vector<FaceSides>> find_face_sides(const MeshView& mesh,
                                                    const ElementLists& lists);

}  // namespace tetmend::formats
