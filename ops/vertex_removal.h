// SPDX-License-Identifier: MIT
// Vertex removal: empties the ball of a vertex and fills it without the vertex.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a vertex. Replaces its ball by the best tetrahedralisation between the vertices around
/// it ([chen, 2.3]). Edge contraction connects them all to one of them; this connects them in any
/// way. Refuses fixed vertices. Refuses as `not_applicable` more than 32 neighbours, and all
/// vertices of a mesh that had inverted tets. Cost: cubic in the neighbours for the tables, and the
/// search.
const OperatorInfo& vertex_removal_info();

}  // namespace tetmend
