// SPDX-License-Identifier: MIT
// Contracts an edge of a surface that may change.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a vertex. Merges a vertex of a patch into a neighbour on the surface, one of a feature
/// line into a neighbour on that line, and moves that to its best place, as `edge_contraction` does
/// inside. Neighbours are tried in the order of what the tets around become.
const OperatorInfo& surface_contraction_info();

}  // namespace tetmend
