// SPDX-License-Identifier: MIT
// Whether a vertex has a place from which it sees all of its link. A pure unit: points in, an answer
// out.
#pragma once

#include <array>
#include <span>

#include "kernel/mesh_data.h"

namespace tetmend {

/// True if there is a place p such that the tet (a, b, c, p) of each face (a, b, c) is positive.
/// Rounding may take a kernel of hardly any volume for none. Source: [wolfe]. Cost: linear in the
/// faces for each of some ten steps.
bool has_kernel(std::span<const std::array<Point, 3>> faces);

}  // namespace tetmend
