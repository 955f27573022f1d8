// SPDX-License-Identifier: MIT
// 2-3 flip: the elementary face removal, a baseline.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a face. Replaces its two tets by three around the edge between their apexes
/// ([chen, Fig. 1a]). Refuses boundary and constrained faces.
const OperatorInfo& flip_2_3_info();

}  // namespace tetmend
