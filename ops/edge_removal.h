// SPDX-License-Identifier: MIT
// Edge removal: the classic baseline, full reduction of one shell.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: an edge. Replaces its shell by the best complete triangulation of the ring
/// ([shewchuk_two]; [chen, 4.1]). Refuses boundary and constrained edges and rings of more than 16.
/// Cost: O(m^3) for degree m.
const OperatorInfo& edge_removal_info();

}  // namespace tetmend
