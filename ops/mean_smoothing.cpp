// SPDX-License-Identifier: MIT
#include "kernel/star.h"
#include "kernel/workspace.h"
#include "ops/builtin_operators.h"
#include "ops/where.h"
#include "search/mean_ratio_ball.h"

namespace tetmend {

namespace {

struct MeanSmoothingState {
  MeanRatioBall ball;
  std::vector<HalfFace> link;
  Point way = Point::Zero();  // from the place before to the best
  double share = 1;           // of the way that is proposed
};

/// Target: vertex. Made for Judge::raises_mean, which polish() sets. Its own judge is strict, like
/// that of others: then it may only do what also helps the worst.
class MeanSmoothing final : public OperatorOf<MeanSmoothingState> {
 public:
  explicit MeanSmoothing(const ParameterValues& values)
      : OperatorOf(mean_smoothing_info()),
        least_gain_(values.real("least_gain")),
        steps_(values.integer("steps")) {}

 protected:
  using State = MeanSmoothingState;

  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    return check_vertex(context.mesh, target.vertex(), Where::inside);
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    const VertexHandle v = target.vertex();
    const StarKind kind = find_star(mesh, v, context.workspace, state.link);
    if (kind != StarKind::whole) return to_verdict(kind);
    const Point start = mesh.point(v);
    state.ball.clear(start);
    for (const HalfFace f : state.link) {
      const auto [a, b, c] = mesh.vertices(f);
      state.ball.add(mesh.point(a), mesh.point(b), mesh.point(c));
    }
    const Point reached = state.ball.descend(start, steps_);
    state.way = reached - start;
    state.share = 1;
    const double gain = state.ball.mean(reached) - state.ball.mean(start);
    return gain >= least_gain_ ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target target, Transaction& transaction,
                State& state) const override {
    const Point goal = context.mesh.point(target.vertex()) + state.share * state.way;
    return to_verdict(transaction.move_vertex(target.vertex(), goal, state.link));
  }

  /// Closer to where it was: a tet may have fallen below the goal on the way.
  bool propose_next(OperatorContext&, Target, State& state) const override {
    constexpr double kLeastShare = 0.25;
    state.share /= 2;
    return state.share >= kLeastShare;
  }

 private:
  double least_gain_;
  int steps_;
};

constexpr std::array<ParameterSpec, 2> kMeanSmoothingParameters = {{
    {"least_gain", ParameterSpec::Kind::real, 1e-6, 1, 2e-3,
     "least gain of the mean over the ball"},
    {"steps", ParameterSpec::Kind::integer, 1, 100, 2, "most steps of Newton's method"},
}};

}  // namespace

const OperatorInfo& mean_smoothing_info() {
  static constexpr OperatorInfo kInfo = describe<MeanSmoothing>(
      "mean_smoothing", TargetKind::vertex,
      "move a vertex to where the tets around it are round on average", kMeanSmoothingParameters);
  return kInfo;
}

}  // namespace tetmend
