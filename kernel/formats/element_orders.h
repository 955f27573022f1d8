// SPDX-License-Identifier: MIT
// Orders of the nodes of second order that formats share.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "kernel/formats/element_kinds.h"

namespace tetmend::formats {

inline constexpr std::array<std::uint8_t, 20> kUprightFirstHexahedron = {
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15};
inline constexpr std::array<std::uint8_t, 15> kUprightFirstPrism = {0, 1,  2,  3,  4, 5,  6, 7,
                                                                    8, 12, 13, 14, 9, 10, 11};

/// Of formats whose nodes on upright edges come before those on top: node order[i] is vertex i of VTK, and
/// the other way round. Empty: the order is the same.
inline std::span<const std::uint8_t> upright_first_order(int vtk_type) {
  if (vtk_type == vtk_hexahedron20) return kUprightFirstHexahedron;
  if (vtk_type == vtk_prism15) return kUprightFirstPrism;
  return {};
}

}  // namespace tetmend::formats
