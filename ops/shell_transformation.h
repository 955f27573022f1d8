// SPDX-License-Identifier: MIT
// Shell transformation: the best covering mesh of the shell of an edge, with or without a core.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: an edge. Replaces its shell by the best covering ([chen, Alg. 3]); the edge vanishes
/// (full reduction) or keeps a smaller shell (partial reduction). Refuses boundary and constrained
/// edges and rings of more than 16. Cost: O(m^3) for degree m.
const OperatorInfo& shell_transformation_info();

}  // namespace tetmend
