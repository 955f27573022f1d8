// SPDX-License-Identifier: MIT
// The order in which tets are painted, so that near ones cover far ones.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::explain {

using TetCorners = std::array<Point, 4>;

/// Seen along `forward` without perspective. Tets that a plane through a face keeps apart are in the
/// right order, also in chains; what cannot be told, or goes round in a circle, is by their centres.
/// Precondition: the tets do not overlap. Cost: quadratic.
std::vector<std::size_t> paint_order(std::span<const TetCorners> tets, const Point& forward);

}  // namespace tetmend::explain
