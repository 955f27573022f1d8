// SPDX-License-Identifier: MIT
// A new vertex at the centroid of a tet, a baseline.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a tet. Inserts a vertex at its centroid, see VertexInsertion. With `max_tets` = 1 this
/// is the 1-4 flip, which seldom improves anything: it divides each angle of the tet.
const OperatorInfo& centroid_insertion_info();

}  // namespace tetmend
