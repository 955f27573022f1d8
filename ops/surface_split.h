// SPDX-License-Identifier: MIT
// Splits an edge of a surface that may change.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: an edge. A new vertex at the middle of an edge of the surface, also of a feature line,
/// then moves along the surface or line to the best place, as `edge_split` does inside.
const OperatorInfo& surface_split_info();

}  // namespace tetmend
