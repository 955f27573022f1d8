// SPDX-License-Identifier: MIT
// What follows an insertion before it is judged: the tets around the new vertex are smoothed and
// reconnected. Shared by the operators that insert.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Moves a vertex to where the worst tet of its ball is best, if that is below `limits.enough`.
/// Fixed vertices and balls across the border of the territory stay.
void climb(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits);

/// Smooths around a new vertex, reconnects its bad tets, smooths again; ends when the second half
/// cannot make up for what the worst tet lost. Leaves the quality vectors of the transaction as
/// they were after the first half in the scratch. Precondition: the star of the vertex lies in the
/// territory. Cost: two smoothings of each vertex of its one-ring.
void relax(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits);

}  // namespace tetmend
