// SPDX-License-Identifier: MIT
// Edge split: a new vertex on an edge, smoothed at once.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: an edge. Puts a vertex at its midpoint, splits the tets of its shell and moves the
/// vertex to where the worst new tet is best ([chen, 6.3]). Under a judge of lengths it stays in the
/// middle, by wanted lengths, if no tet is too bad there. With `relax`, the tets around the new
/// vertex are then reconnected and its neighbours smoothed before the outcome is judged. Refuses
/// boundary and constrained edges, and splits that pay for a better worst tet with many new bad
/// ones, so that the mesh does not grow for nothing. Cost: the smoothing of one vertex, with
/// `relax` of about 30 and of their shells.
const OperatorInfo& edge_split_info();

}  // namespace tetmend
