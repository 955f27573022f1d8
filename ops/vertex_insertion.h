// SPDX-License-Identifier: MIT
// What all operators that insert a vertex into a tet share: the cavity of the new vertex. Its tets
// are replaced by tets between the vertex and the outer faces of the cavity.
#pragma once

#include "kernel/index_set.h"
#include "ops/smoothing.h"
#include "search/mean_ratio_ball.h"

namespace tetmend {

struct VertexInsertionState {
  BallState ball;  // link: the outer faces of the cavity
  MeanRatioBall mean_ball;
  IndexSet inside;
  Replacement replacement;
};

/// Target: a tet. Inserts a vertex at a place that the derived class names, as in Delaunay
/// refinement ([chen, 2.3]). It replaces the tets around whose circumspheres hold the vertex,
/// except where the vertex would not see the faces behind them. The cavity crosses no constrained
/// face and holds `max_tets` at most. With `smooth`, the vertex then moves to where the worst new
/// tet is best.
///
/// Refuses as `not_applicable` a target that is not certified positive, or whose vertex lies more
/// than 64 tets away. Refuses as `constrained` when boundary or a constrained face parts the target
/// from the vertex, or when the cavity would swallow a fixed vertex. Refuses as `no_improvement`
/// when the target would stay, or when the worst tet would be no better, or only at the price of
/// many new bad tets (as edge_split). Cost: the way to the vertex, the square of the size of the
/// cavity at worst, and the smoothing of one vertex.
class VertexInsertion : public OperatorOf<VertexInsertionState> {
 public:
  VertexInsertion(const OperatorInfo& info, const ParameterValues& values);
  static std::span<const ParameterSpec> parameters();

 protected:
  /// Where the vertex goes. The tet is certified positive.
  virtual Point place(const TetMesh& mesh, TetHandle t) const = 0;

  using State = VertexInsertionState;
  Verdict precondition(const OperatorContext& context, Target target, State& state) const final;
  Verdict evaluate(OperatorContext& context, Target target, State& state) const final;
  Verdict apply(OperatorContext& context, Target target, Transaction& transaction,
                State& state) const final;

 private:
  /// Moves the vertex to where the new tets are round on average. False if their mean ratios, each less
  /// the usual one, have no larger sum than those of the cavity.
  static bool raises_mean(const TetMesh& mesh, double usual, State& state);

  std::size_t max_tets_;
  bool smooth_;
  BallOptimiser::Limits limits_;
};

}  // namespace tetmend
