// SPDX-License-Identifier: MIT
#include "ops/surface_split.h"

#include <algorithm>

#include "kernel/surface_shell.h"
#include "ops/relaxation.h"
#include "ops/surface_replacement.h"
#include "ops/surface_vertex.h"

namespace tetmend {

namespace {

struct State {
  SurfaceShell shell;
  BallOptimiser ball;
  SurfaceReplacement replacement;
  RelaxationState relaxation;
};

/// Until the new vertex exists: the plane or line of the edge.
class OnEdge final : public PlaceRestriction {
 public:
  OnEdge(const Point& origin, const Point& direction, bool on_line)
      : origin_(origin), direction_(direction), on_line_(on_line) {}
  void turn_along(const Point&, std::span<Point> vectors) const override {
    for (Point& vector : vectors) vector = part(vector);
  }
  Point nearest(const Point& p) const override { return origin_ + part(p - origin_); }

 private:
  Point part(const Point& vector) const {
    const Point along = direction_.dot(vector) * direction_;
    return on_line_ ? along : Point(vector - along);
  }

  Point origin_, direction_;
  bool on_line_;
};

class SurfaceSplit final : public OperatorOf<State> {
 public:
  explicit SurfaceSplit(const ParameterValues& values)
      : OperatorOf(surface_split_info(), Judge::fair({.desperate = values.real("desperate")})),
        least_gain_(values.real("least_gain")),
        relax_(values.flag("relax")),
        max_degree_(static_cast<unsigned>(values.integer("max_degree"))) {
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target, State& state) const override {
    const Verdict verdict = find_surface_edge(context, target.edge(), state.shell);
    if (verdict != Verdict::accepted) return verdict;
    unsigned degree = 0;
    for (unsigned s = 0; s < state.shell.side_count; ++s) degree += state.shell.sides[s].count;
    return degree <= max_degree_ ? Verdict::accepted : Verdict::not_applicable;
  }

  /// Places the vertex before it exists: the ball of the new vertex is the shell.
  Verdict evaluate(OperatorContext& context, Target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    const SurfaceShell& shell = state.shell;
    const Point& a = mesh.point(shell.a);
    const Point& b = mesh.point(shell.b);
    state.ball.clear(mesh.standard());
    Quality worst = mesh.quality(shell.sides[0].tets[0]);
    for (unsigned s = 0; s < shell.side_count; ++s) {
      const ShellSide& side = shell.sides[s];
      worst = std::min(worst, worst_quality(mesh, std::span(side.tets).first(side.count)));
      for (unsigned i = 0; i < side.count; ++i) {
        const Point& p = mesh.point(side.ring[i]);
        const Point& q = mesh.point(side.ring[i + 1]);
        state.ball.add(a, q, p);
        state.ball.add(b, p, q);
      }
    }
    double least = context.judge->floor(worst, least_gain_);
    if (relax_) {
      // What is left to be gained by smoothing the neighbours is limited.
      constexpr double kRelaxedShare = 0.2;
      least = std::max(0.0, std::min(least, kRelaxedShare * worst));
    }
    Point place = 0.5 * (a + b);
    const OnEdge restriction = restrict(mesh, shell, place);
    state.ball.restrict_to(restriction);
    const double reached = state.ball.optimise(place, limits_);
    return reached > least ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction,
                State& state) const override {
    const TetMesh& mesh = context.mesh;
    const SurfaceShell& shell = state.shell;
    const VertexHandle v =
        transaction.add_vertex(0.5 * (mesh.point(shell.a) + mesh.point(shell.b)));
    if (!v.is_valid()) return Verdict::deferred;
    state.replacement.clear();
    for (unsigned s = 0; s < shell.side_count; ++s) {
      const ShellSide& side = shell.sides[s];
      for (unsigned i = 0; i < side.count; ++i) {
        const Label label = mesh.label(side.tets[i]);
        state.replacement.old_tets.push_back(side.tets[i]);
        state.replacement.add({shell.a, v, side.ring[i], side.ring[i + 1]}, label);
        state.replacement.add({v, shell.b, side.ring[i], side.ring[i + 1]}, label);
      }
    }
    const Verdict verdict = state.replacement.make(transaction);
    if (verdict != Verdict::accepted) return verdict;
    if (relax_) {
      relax(context, transaction, v, limits_, state.relaxation, true);
    } else {
      climb_at_surface(context, transaction, v, limits_, state.relaxation.ball);
    }
    return Verdict::accepted;
  }

 private:
  /// The line of a feature edge; else the plane of the two faces of the surface at the edge, or one
  /// between them.
  static OnEdge restrict(const TetMesh& mesh, const SurfaceShell& shell, const Point& middle) {
    const Point& a = mesh.point(shell.a);
    const Point along = (mesh.point(shell.b) - a).normalized();
    if (mesh.surface_guard()->is_feature(shell.a, shell.b)) return {middle, along, true};
    const ShellSide& side = shell.sides[0];
    const auto normal = [&](VertexHandle p) -> Point { return along.cross(mesh.point(p) - a); };
    const Point sum =
        normal(side.ring[0]).normalized() - normal(side.ring[side.count]).normalized();
    const double length = sum.norm();
    return {middle, length > 0 ? Point(sum / length) : along, false};
  }

  double least_gain_;
  bool relax_;
  unsigned max_degree_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 5> kParameters = {{
    {"least_gain", ParameterSpec::Kind::real, 0, 1, 2e-4,
     "least gain of the worst quality of the shell"},
    {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
     "below this worst quality, a gain of 0.002 pays for one more bad tet"},
    {"relax", ParameterSpec::Kind::flag, 0, 1, 1,
     "smooth and reconnect around the new vertex before judging"},
    {"max_degree", ParameterSpec::Kind::integer, 1, 2 * kMaxDegree, 16,
     "most tets at an edge that is split"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 8,
     "most directions that each placement follows"},
}};

}  // namespace

const OperatorInfo& surface_split_info() {
  static const OperatorInfo kInfo = {
      "surface_split", TargetKind::edge,
      "insert a vertex on an edge of a surface that may change and smooth it there", kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<SurfaceSplit>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
