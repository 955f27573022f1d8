// SPDX-License-Identifier: MIT
// 4-4 flip: another edge for the same octahedron.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: an edge. Replaces the four tets of its shell by four around one of the two diagonals of
/// its ring, the one with the better quality vector ([chen, Fig. 1b]). Refuses boundary and
/// constrained edges, and shells of another degree.
const OperatorInfo& flip_4_4_info();

}  // namespace tetmend
