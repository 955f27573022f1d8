// SPDX-License-Identifier: MIT
// Smoothing of one vertex: smart Laplacian, then optimisation.
#pragma once

#include "ops/operator.h"
#include "search/ball_optimiser.h"

namespace tetmend {

/// Target: a vertex. Moves it to the mean of its neighbours if that improves its ball. If bad tets
/// remain, climbs from there to where the worst tet of the ball is best ([chen, 6.2];
/// [freitag_ollivier_gooch]). Refuses fixed vertices.
const OperatorInfo& smoothing_info();

/// What operators on the ball of a vertex remember: its link, and its best place in there.
struct BallState {
  BallOptimiser ball;
  std::vector<HalfFace> link;
  Point point = Point::Zero();
};

/// Loads the ball around a vertex, given by its link, into the optimiser.
void load_ball(const TetMesh& mesh, std::span<const HalfFace> link, BallOptimiser& ball);

/// Moves a vertex to where the worst tet of its ball is best, as part of a larger change. Leaves it
/// where it is if it is fixed, its ball is good enough or partly in another worker's territory, or
/// nothing is gained.
void climb(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits, BallState& state);

}  // namespace tetmend
