// SPDX-License-Identifier: MIT
// 3-2 flip: the elementary edge removal, a baseline.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: an edge. Replaces the three tets of its shell by the two at the triangle of its ring
/// ([chen, Fig. 1a]). Refuses boundary and constrained edges, and shells of another degree.
const OperatorInfo& flip_3_2_info();

}  // namespace tetmend
