// SPDX-License-Identifier: MIT
// Operator: move a vertex so that the tets around it become round on average.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: vertex. Made for Judge::raises_mean, which polish() sets. Its own judge is strict, like
/// that of others: then it may only do what also helps the worst.
const OperatorInfo& mean_smoothing_info();

}  // namespace tetmend
