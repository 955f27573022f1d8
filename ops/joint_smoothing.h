// SPDX-License-Identifier: MIT
// Smoothing of all vertices of a bad tet at once.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a tet. Moves its free vertices together to where the tets around them lack less
/// (PatchOptimiser). This is for tets that no vertex can improve alone. Refuses as `constrained` a
/// tet without a free vertex. Refuses as `not_applicable` a tet around which all is good, or with
/// too many tets around it.
const OperatorInfo& joint_smoothing_info();

}  // namespace tetmend
