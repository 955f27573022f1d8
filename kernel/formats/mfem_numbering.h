// SPDX-License-Identifier: MIT
// How MFEM numbers kinds of elements and edges.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "kernel/formats/element_kinds.h"
#include "kernel/second_order.h"

namespace tetmend::formats {

/// By MFEM's numbers of geometries.
inline constexpr std::array<int, 8> kMfemTypes = {
    vtk_point, vtk_edge, vtk_triangle, vtk_quad, vtk_tet, vtk_hexahedron, vtk_prism, vtk_pyramid};

/// The edges of a tet in the order in which MFEM numbers them.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> kMfemEdgesOfTet = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Edges count from 0 as they come first in the tets: as MFEM counts them.
class MfemEdges {
 public:
  std::uint32_t add(std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(ends.size());
    const auto [at, is_new] = numbers_.try_emplace(edge_key(a, b), next);
    if (is_new) ends.push_back({a, b});
    return at->second;
  }
  std::vector<std::array<std::uint32_t, 2>> ends;

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
};

}  // namespace tetmend::formats
