// SPDX-License-Identifier: MIT
#include "ops/smoothing.h"

#include <algorithm>

#include "kernel/star.h"

namespace tetmend {

namespace {

class Smoothing final : public Operator {
 public:
  explicit Smoothing(const ParameterValues& values)
      : Operator(smoothing_info()),
        laplacian_(values.flag("laplacian")),
        optimise_(values.flag("optimise")),
        desperate_(values.real("desperate")),
        least_gain_(values.real("least_gain")) {
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target) const override {
    const VertexHandle v = target.vertex();
    if (context.mesh.is_deleted(v) || !context.mesh.tet_of(v).is_valid())
      return Verdict::not_applicable;
    return context.mesh.is_fixed(v) ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target) const override {
    const TetMesh& mesh = context.mesh;
    Scratch& scratch = context.scratch;
    const VertexHandle v = target.vertex();
    if (!collect_link(mesh, v, context.workspace, scratch.link)) return Verdict::deferred;
    load_ball(mesh, scratch.link, scratch.ball);
    scratch.point = mesh.point(v);
    const double start = scratch.ball.worst(scratch.point);
    const double start_deficit = scratch.ball.total_deficit();
    double reached = start;
    if (laplacian_) {
      const Point mean = mean_of_neighbours(mesh, scratch);
      const double least = std::max(start, 0.0);
      const double value = scratch.ball.worst_above(mean, least);
      if (value > least) {
        scratch.point = mean;
        reached = value;
      }
    }
    if (optimise_ && reached < kBadThreshold)
      reached = scratch.ball.optimise_from(scratch.point, reached, limits_);
    if (!(reached > start + least_gain_)) return Verdict::no_improvement;
    // DEVIATION: as in edge_split, a small gain of the worst tet must not be paid by many others.
    if (start >= desperate_ && !(scratch.ball.total_deficit() < start_deficit))
      return Verdict::no_improvement;
    return Verdict::accepted;
  }

  Verdict apply(OperatorContext& context, Target target, Transaction& transaction) const override {
    return to_verdict(
        transaction.move_vertex(target.vertex(), context.scratch.point, context.scratch.link));
  }

 private:
  static Point mean_of_neighbours(const TetMesh& mesh, Scratch& scratch) {
    Point sum = Point::Zero();
    scratch.set.clear();
    for (const HalfFace f : scratch.link) {
      for (const VertexHandle w : mesh.vertices(f)) {
        if (scratch.set.insert(w.index())) sum += mesh.point(w);
      }
    }
    return sum / static_cast<double>(scratch.set.size());
  }

  bool laplacian_;
  bool optimise_;
  double desperate_;
  double least_gain_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 5> kParameters = {{
    {"laplacian", ParameterSpec::Kind::flag, 0, 1, 1, "try the mean of the neighbours first"},
    {"optimise", ParameterSpec::Kind::flag, 0, 1, 1,
     "then climb to the best place if bad tets remain"},
    {"desperate", ParameterSpec::Kind::real, -1, 1, kDesperate,
     "below this worst quality, new bad tets are no reason to refuse"},
    {"least_gain", ParameterSpec::Kind::real, kQualityTolerance, 1, 1e-3,
     "least gain of the worst quality of the ball"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 6,
     "most directions that the optimisation follows"},
}};

}  // namespace

void load_ball(const TetMesh& mesh, std::span<const HalfFace> link, BallOptimiser& ball) {
  ball.clear();
  for (const HalfFace f : link) {
    const auto [a, b, c] = mesh.vertices(f);
    ball.add(mesh.point(a), mesh.point(b), mesh.point(c));
  }
}

void climb(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits) {
  const TetMesh& mesh = context.mesh;
  if (mesh.is_fixed(v)) return;
  Scratch& scratch = context.scratch;
  if (!collect_link(mesh, v, context.workspace, scratch.link)) return;
  load_ball(mesh, scratch.link, scratch.ball);
  Point point = mesh.point(v);
  const double start = scratch.ball.worst(point);
  if (start >= limits.enough || scratch.ball.optimise_from(point, start, limits) <= start) return;
  transaction.move_vertex(v, point, scratch.link);
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
