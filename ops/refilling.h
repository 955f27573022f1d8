// SPDX-License-Identifier: MIT
// From a polyhedron of the mesh to a search and back: what the operators that empty a polyhedron
// share.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// The problem of filling a polyhedron with a better worst tet and, unless the worst is desperate
/// now, bad tets that lack no more in sum. All else is as PolyhedronProblem has it: no vertex need
/// be kept.
PolyhedronProblem better_filling(const TetMesh& mesh, const Polyhedron& polyhedron,
                                 Quality desperate);

/// Searches a filling for the polyhedron of the scratch and leaves old and new tets in the scratch.
/// The search of the scratch has the vertices of the polyhedron and may have one more, `added`.
/// `accepted` if it found one, `budget_spent` if the nodes were spent before. Precondition: the
/// tets of the polyhedron do not overlap.
Verdict refill(OperatorContext& context, const PolyhedronProblem& problem, VertexHandle added = {});

}  // namespace tetmend
