// SPDX-License-Identifier: MIT
// Edge contraction: removes a vertex by merging it into a neighbour, which is then smoothed.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a vertex. Tries to merge it into each neighbour, takes the neighbour with the best
/// quality vector, and smooths that neighbour unless it is fixed ([chen, 6.3]). Refuses fixed
/// vertices. Parameters: least_ratio (0.3): least worst quality before smoothing, as a share of the
/// worst quality of the ball, steps (8). Cost: linear in ball size times neighbours.
const OperatorInfo& edge_contraction_info();

}  // namespace tetmend
