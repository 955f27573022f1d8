// SPDX-License-Identifier: MIT
// What follows an insertion before it is judged: the tets around the new vertex are smoothed and
// reconnected. Shared by the operators that insert.
#pragma once

#include "ops/shell_search.h"
#include "ops/vertex_ball.h"

namespace tetmend {

struct RelaxationState {
  BallState ball;
  ShellState shell;
  std::vector<VertexHandle> neighbours;
  Comparison halfway;
};

/// Smooths around a new vertex, reconnects its bad tets, smooths again; ends when the second half
/// cannot make up for what the worst tet lost. Precondition: the star of the vertex lies in the
/// territory. Cost: two smoothings of each vertex of its one-ring.
/// @param where at the surface also vertices of a surface that may change
void relax(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits, RelaxationState& state, Where where);

}  // namespace tetmend
