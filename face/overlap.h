// SPDX-License-Identifier: MIT
// How much two tets have in common.
#pragma once

#include <array>

#include "kernel/mesh_data.h"

namespace tetmend::face {

/// Volume of what the two tets share, in whichever order their vertices are. Cost: up to 81 small
/// tets are cut out of the first.
double overlap(const std::array<Point, 4>& a, const std::array<Point, 4>& b);

}  // namespace tetmend::face
