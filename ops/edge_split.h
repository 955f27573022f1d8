// SPDX-License-Identifier: MIT
// Edge split: a new vertex on an edge, smoothed at once.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: an edge. Puts a vertex at its midpoint, splits the tets of its shell and moves the vertex to where the worst new tet is
/// best ([chen, 6.3]). Refuses boundary and constrained edges, and gains of the worst quality below `least_gain`, so that the mesh does
/// not grow for nothing. Parameters: least_gain (1e-4), max_degree (12), steps (8).
const OperatorInfo& edge_split_info();

}  // namespace tetmend
