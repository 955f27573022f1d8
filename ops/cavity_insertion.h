// SPDX-License-Identifier: MIT
// Insertion of a vertex into the cavity that suits it best.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a tet, which gives way to a new vertex together with the tets around whose removal makes
/// the worst new tet best ([klingner_shewchuk]; see VertexCavity). Places for the vertex are the
/// centroid of the tet and those of its faces and edges. At each, the vertex moves to the best
/// place in its cavity and the cavity is chosen anew. The `tries` most promising of these are made,
/// one after the other, until one stands the test: with `relax`, after the tets around were
/// smoothed and reconnected (see relaxation.h). The test is that of edge_split, but for the
/// `exponent` in the sum of what the bad tets lack: with 4, as there, a hard place is given up that
/// needs mild bad tets on the way; without any such test, or with a larger `desperate`, it breeds
/// them.
///
/// DEVIATION: the source tries one place for a vertex; others are what makes stubborn tets go.
///
/// Refuses as `no_improvement` also when all cavities promise less than half of the quality of the
/// target; as `constrained` when a cavity would swallow a fixed vertex or a constrained edge.
/// Cost: the growth of some 30 cavities and the smoothing of one vertex in each, and a relaxation
/// for each try.
const OperatorInfo& cavity_insertion_info();

}  // namespace tetmend
