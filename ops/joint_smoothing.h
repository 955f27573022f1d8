// SPDX-License-Identifier: MIT
// Smoothing of all vertices of a bad tet at once.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a tet. Moves its free vertices together to where the tets around them lack less
/// (PatchOptimiser): for tets that no vertex can better alone. Refuses as `constrained` a tet
/// without a free vertex, as `not_applicable` one around which all is good or too much to be looked
/// at.
const OperatorInfo& joint_smoothing_info();

}  // namespace tetmend
