// SPDX-License-Identifier: MIT
#include "ops/smoothing.h"

#include <algorithm>

#include "kernel/star.h"

namespace tetmend {

namespace {

struct State {
  BallState ball;
  IndexSet neighbours;
};

class Smoothing final : public OperatorOf<State> {
 public:
  explicit Smoothing(const ParameterValues& values)
      // A gain of a desperate tet is worth any number of bad ones.
      : OperatorOf(smoothing_info(),
                   Judge::fair({.desperate = values.real("desperate"), .price = 0})),
        laplacian_(values.flag("laplacian")),
        optimise_(values.flag("optimise")),
        least_gain_(values.real("least_gain")) {
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    const VertexHandle v = target.vertex();
    if (context.mesh.is_deleted(v) || !context.mesh.tet_of(v).is_valid())
      return Verdict::not_applicable;
    return context.mesh.is_fixed(v) ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    auto& [ball, link, point] = state.ball;
    const VertexHandle v = target.vertex();
    const StarKind kind = find_star(mesh, v, context.workspace, link);
    if (kind != StarKind::whole) return to_verdict(kind);
    load_ball(mesh, link, ball);
    point = mesh.point(v);
    const double start = ball.worst(point);
    const double deficit_limit = context.judge->deficit_limit(start, ball.total_deficit());
    double reached = start;
    if (laplacian_) {
      const Point mean = mean_of_neighbours(mesh, state);
      const double least = std::max(start, 0.0);
      const double value = ball.worst_above(mean, least);
      if (value > least) {
        point = mean;
        reached = value;
      }
    }
    if (optimise_ && reached < kBadThreshold) reached = ball.optimise_from(point, reached, limits_);
    if (!(reached > context.judge->floor(start, least_gain_))) return Verdict::no_improvement;
    // Less, not as much: a ball without bad tets stays as it is.
    return ball.total_deficit() < deficit_limit ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext&, Target target, Transaction& transaction,
                State& state) const override {
    return to_verdict(transaction.move_vertex(target.vertex(), state.ball.point, state.ball.link));
  }

 private:
  static Point mean_of_neighbours(const TetMesh& mesh, State& state) {
    Point sum = Point::Zero();
    state.neighbours.clear();
    for (const HalfFace f : state.ball.link) {
      for (const VertexHandle w : mesh.vertices(f)) {
        if (state.neighbours.insert(w.index())) sum += mesh.point(w);
      }
    }
    return sum / static_cast<double>(state.neighbours.size());
  }

  bool laplacian_;
  bool optimise_;
  double least_gain_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 5> kParameters = {{
    {"laplacian", ParameterSpec::Kind::flag, 0, 1, 1, "try the mean of the neighbours first"},
    {"optimise", ParameterSpec::Kind::flag, 0, 1, 1,
     "then climb to the best place if bad tets remain"},
    {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
     "below this worst quality, new bad tets are no reason to refuse"},
    {"least_gain", ParameterSpec::Kind::real, kQualityTolerance, 1, 2e-3,
     "least gain of the worst quality of the ball"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 6,
     "most directions that the optimisation follows"},
}};

}  // namespace

void load_ball(const TetMesh& mesh, std::span<const HalfFace> link, BallOptimiser& ball) {
  ball.clear(mesh.standard());
  for (const HalfFace f : link) {
    const auto [a, b, c] = mesh.vertices(f);
    ball.add(mesh.point(a), mesh.point(b), mesh.point(c));
  }
}

void climb(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits, BallState& state) {
  const TetMesh& mesh = context.mesh;
  if (mesh.is_fixed(v)) return;
  auto& [ball, link, point] = state;
  if (find_star(mesh, v, context.workspace, link) != StarKind::whole) return;
  load_ball(mesh, link, ball);
  point = mesh.point(v);
  const double start = ball.worst(point);
  if (start >= limits.enough || ball.optimise_from(point, start, limits) <= start) return;
  transaction.move_vertex(v, point, link);
}

const OperatorInfo& smoothing_info() {
  static const OperatorInfo kInfo = {
      "smoothing", TargetKind::vertex,
      "move a vertex: smart Laplacian, then optimisation of the worst tet", kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<Smoothing>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
