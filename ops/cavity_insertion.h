// SPDX-License-Identifier: MIT
// Insertion of a vertex into the cavity that suits it best.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a tet. Replaces it by tets at a new vertex, together with those tets around it whose
/// removal makes the worst new tet best ([klingner_shewchuk]; see VertexCavity). Places for the
/// vertex are the centroids of the tet, its faces and its edges. At each, the vertex moves to the
/// best place in its cavity, and the cavity is chosen again. The `tries` most promising places are
/// tried one after the other until one is worth it. With `relax`, the tets around are smoothed and
/// reconnected before that is judged (see relaxation.h). The rule is that of edge_split with an
/// `exponent` of its own for what bad tets lack. With 4, as there, places are given up that need
/// mild bad tets on the way. Without the rule, or with a larger `desperate`, more and more such
/// tets appear.
///
/// DEVIATION: the source tries one place for a vertex; stubborn tets need others.
///
/// Refuses as `no_improvement` also when all cavities promise less than half of the quality of the
/// target. Refuses as `constrained` when a cavity would swallow a fixed vertex or a constrained
/// edge.
/// Cost: the growth of some 30 cavities and the smoothing of one vertex in each, and a relaxation
/// for each try.
const OperatorInfo& cavity_insertion_info();

}  // namespace tetmend
