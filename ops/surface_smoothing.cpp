// SPDX-License-Identifier: MIT
#include "ops/surface_smoothing.h"

#include "kernel/star.h"
#include "ops/surface_vertex.h"

namespace tetmend {

namespace {

struct State {
  BallState ball;
  double least = 0;  // what the ball must exceed
  double deficit_limit = 0;
  unsigned halves = 0;  // so often the way was halved
};

class SurfaceSmoothing final : public OperatorOf<State> {
 public:
  explicit SurfaceSmoothing(const ParameterValues& values)
      : OperatorOf(surface_smoothing_info(),
                   Judge::fair({.desperate = values.real("desperate"), .price = 0})),
        least_gain_(values.real("least_gain")),
        most_halves_(static_cast<unsigned>(values.integer("halves"))) {
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    const VertexHandle v = target.vertex();
    const TetMesh& mesh = context.mesh;
    if (mesh.is_deleted(v) || !mesh.tet_of(v).is_valid()) return Verdict::not_applicable;
    if (!mesh.is_fixed(v)) return Verdict::not_applicable;
    return may_change(mesh, v) ? Verdict::accepted : Verdict::constrained;
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    auto& [ball, link, point] = state.ball;
    const VertexHandle v = target.vertex();
    const StarKind kind = find_star(mesh, v, context.workspace, link);
    if (kind != StarKind::whole) return to_verdict(kind);
    load_ball(mesh, link, ball);
    const OnSurface restriction(*mesh.surface_guard(), v);
    ball.restrict_to(restriction);
    point = mesh.point(v);
    state.halves = 0;
    const double start = ball.worst(point);
    if (start >= kBadThreshold) return Verdict::no_improvement;
    state.deficit_limit = context.judge->deficit_limit(start, ball.total_deficit());
    state.least = context.judge->floor(start, least_gain_);
    if (!(ball.optimise_from(point, start, limits_) > state.least)) return Verdict::no_improvement;
    return ball.total_deficit() < state.deficit_limit ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext&, Target target, Transaction& transaction,
                State& state) const override {
    const VertexMove move = {target.vertex(), state.ball.point, state.ball.link};
    return to_verdict(transaction.move_at_surface({&move, 1}));
  }

  bool propose_next(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    const VertexHandle v = target.vertex();
    if (state.halves++ == most_halves_) return false;
    auto& [ball, link, point] = state.ball;
    point = mesh.surface_guard()->nearest(v, 0.5 * (mesh.point(v) + point));
    return ball.worst_above(point, state.least) > state.least &&
           ball.total_deficit() < state.deficit_limit;
  }

 private:
  double least_gain_;
  unsigned most_halves_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 4> kParameters = {{
    {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
     "below this worst quality, new bad tets are no reason to refuse"},
    {"least_gain", ParameterSpec::Kind::real, kQualityTolerance, 1, 2e-3,
     "least gain of the worst quality of the ball"},
    {"halves", ParameterSpec::Kind::integer, 0, 20, 4, "how often a way that is refused is halved"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 12,
     "most directions that the optimisation follows"},
}};

}  // namespace

const OperatorInfo& surface_smoothing_info() {
  static const OperatorInfo kInfo = {
      "surface_smoothing",
      TargetKind::vertex,
      "move a vertex of a surface that may change along it to the best place",
      kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<SurfaceSmoothing>(values);
      },
      true};
  return kInfo;
}

}  // namespace tetmend
