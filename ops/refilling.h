// SPDX-License-Identifier: MIT
// From a polyhedron of the mesh to a search and back: what the operators that empty a polyhedron
// share.
#pragma once

#include "ops/operator.h"
#include "ops/polyhedron.h"

namespace tetmend {

struct RefillingState {
  Polyhedron polyhedron;
  PolyhedronSearch search;
  Replacement replacement;
};

/// The problem of filling a polyhedron with tets that the judge may accept. All else is as
/// PolyhedronProblem has it: no vertex need be kept.
PolyhedronProblem better_filling(const TetMesh& mesh, const Polyhedron& polyhedron,
                                 const Judge& judge);

/// Searches a filling for the polyhedron of the state and leaves it in the replacement. The search
/// of the state has the vertices of the polyhedron and may have one more, `added`.
/// `accepted` if it found one, `budget_spent` if the nodes were spent before. Precondition: the
/// tets of the polyhedron do not overlap.
Verdict refill(const PolyhedronProblem& problem, RefillingState& state, VertexHandle added = {});

}  // namespace tetmend
