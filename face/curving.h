// SPDX-License-Identifier: MIT
// Curved tets that are turned over: edges within the volume are curved until they are not, or edges of
// the surface are made straight.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::face {

/// What curve_inside() did.
struct Curving {
  std::size_t curved = 0;        ///< edges within the volume that were given another bend
  std::size_t straightened = 0;  ///< edges of the surface and of walls
  std::size_t left = 0;          ///< tets that stay turned over
  std::vector<std::string> notes;
};

/// Moves mid-side nodes of `data` so that fewer tets are turned over: of edges that are neither on the
/// surface or walls nor named or of elements of other kinds, nor of tets that `is_frozen` tells. No tet
/// at an edge that is changed becomes worse than the worst there was. With `straightens` the nodes of
/// other edges go to their middles where that does not help, but for required ones.
/// Cost: n log n, and some hundredths of a second for each tet that is turned over; hardly any where
/// none is.
/// @param is_frozen by tet, or empty: none is
Curving curve_inside(MeshData& data, const std::vector<bool>& is_frozen, bool straightens);

}  // namespace tetmend::face
