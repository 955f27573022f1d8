// SPDX-License-Identifier: MIT
// Recursive shell transformation: removes an edge by first removing edges of the shells around it.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: an edge. Transforms its shell. While that is not fully reduced, removes supporting faces
/// by recursive calls on their reflex link edges ([chen, Alg. 4, 5.1-5.3]). Each transformation
/// improves the quality vector of its own shell, so partial success is kept.
const OperatorInfo& recursive_shell_transformation_info();

}  // namespace tetmend
