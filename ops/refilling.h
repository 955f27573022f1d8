// SPDX-License-Identifier: MIT
// From a polyhedron of the mesh to a search and back: what the operators that empty a polyhedron
// share.
#pragma once

#include "ops/operator.h"

namespace tetmend {

struct RefillLimits {
  unsigned max_nodes;
  Quality desperate;  ///< below this worst quality, new bad tets are no reason to refuse
};

/// Searches a better filling for the polyhedron of the scratch, whose vertices the search of the
/// scratch already has, and leaves old and new tets in the scratch. `accepted` if its worst tet is
/// better and, unless the old worst is desperate, the bad tets lack no more in sum; `budget_spent`
/// if the nodes were spent before one was found. `kept`: vertices inside that must stay.
/// Precondition: the tets of the polyhedron do not overlap.
Verdict refill(OperatorContext& context, PointMask kept, const RefillLimits& limits);

}  // namespace tetmend
