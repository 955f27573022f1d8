// SPDX-License-Identifier: MIT
// Edge contraction: removes a vertex by merging it into a neighbour, which is then smoothed.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a vertex. Tries to merge it into each neighbour, takes the neighbour with the best
/// quality vector, and smooths that neighbour unless it is fixed ([chen, 6.3]). Refuses fixed
/// vertices. Under a judge of lengths the neighbours are those that are too near, and stay where they
/// are. Else a neighbour that may move must promise a share of the worst quality of the ball, the
/// `least_ratio`, before it is smoothed. Cost: linear in ball size times neighbours.
const OperatorInfo& edge_contraction_info();

}  // namespace tetmend
