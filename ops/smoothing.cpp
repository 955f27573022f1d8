// SPDX-License-Identifier: MIT
#include <algorithm>

#include "kernel/star.h"
#include "kernel/workspace.h"
#include "ops/builtin_operators.h"
#include "ops/vertex_ball.h"

namespace tetmend {

namespace {

struct SmoothingState {
  BallState ball;
  IndexSet neighbours;
  double least = 0;  // what the ball must exceed
  double deficit_limit = 0;
  unsigned halves = 0;  // so often the way was halved
};

/// Target: a vertex. Inside moves it to the mean of its neighbours if that improves its ball. If
/// bad tets remain, climbs from there to where the worst tet of the ball is best ([chen, 6.2];
/// [freitag_ollivier_gooch]). At the surface only climbs, a vertex of a patch in its tangent
/// plane, one of a feature line along it; each place is pulled back to the nearest of the patch or
/// line. Where the guard of the surface refuses, half of the way is tried. Refuses vertices of the
/// other kind.
template <Where At>
class Smoothing final : public OperatorOf<SmoothingState> {
 public:
  explicit Smoothing(const ParameterValues& values)
      // A gain of a desperate tet is worth any number of bad ones.
      : OperatorOf(kInside ? smoothing_info() : surface_smoothing_info(),
                   Judge::fair({.desperate = values.real("desperate"), .price = 0})),
        laplacian_(kInside && values.flag("laplacian")),
        optimise_(!kInside || values.flag("optimise")),
        most_halves_(kInside ? 0 : static_cast<unsigned>(values.integer("halves"))),
        least_gain_(values.real("least_gain")) {
    limits_.steps = values.integer("steps");
  }

 protected:
  using State = SmoothingState;

  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    return check_vertex(context.mesh, target.vertex(), At);
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    auto& [ball, link, point] = state.ball;
    const VertexHandle v = target.vertex();
    const StarKind kind = find_star(mesh, v, context.workspace, link);
    if (kind != StarKind::whole) return to_verdict(kind);
    load_ball(mesh, link, ball);
    point = mesh.point(v);
    state.halves = 0;
    const double start = ball.worst(point);
    if (!kInside && start >= kBadThreshold) return Verdict::no_improvement;
    state.deficit_limit = context.judge->deficit_limit(start, ball.total_deficit());
    state.least = context.judge->floor(start, least_gain_);
    const double reached = find_place(mesh, v, start, state);
    if (!(reached > state.least)) return Verdict::no_improvement;
    // Less, not as much: a ball without bad tets stays as it is.
    return ball.total_deficit() < state.deficit_limit ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext&, Target target, Transaction& transaction,
                State& state) const override {
    const VertexMove move = {target.vertex(), state.ball.point, state.ball.link};
    return to_verdict(kInside ? transaction.move_vertex(move.vertex, move.point, move.link)
                              : transaction.move_at_surface({&move, 1}));
  }

  bool propose_next(OperatorContext& context, Target target, State& state) const override {
    if (kInside || state.halves++ == most_halves_) return false;
    const TetMesh& mesh = context.mesh;
    const VertexHandle v = target.vertex();
    auto& [ball, link, point] = state.ball;
    point = mesh.surface_guard()->nearest(v, 0.5 * (mesh.point(v) + point));
    return ball.worst_above(point, state.least) > state.least &&
           ball.total_deficit() < state.deficit_limit;
  }

 private:
  static constexpr bool kInside = At == Where::inside;

  /// Moves the point of the ball, and answers the quality of the worst tet there.
  double find_place(const TetMesh& mesh, VertexHandle v, double start, State& state) const {
    auto& [ball, link, point] = state.ball;
    if constexpr (!kInside) {
      const OnSurface restriction(*mesh.surface_guard(), v);
      ball.restrict_to(restriction);
      return ball.optimise_from(point, start, limits_);
    }
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
    if (!optimise_ || reached >= kBadThreshold) return reached;
    return ball.optimise_from(point, reached, limits_);
  }

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
  unsigned most_halves_;
  double least_gain_;
  BallOptimiser::Limits limits_;
};

constexpr ParameterSpec kSmoothingDesperate = {
    "desperate", ParameterSpec::Kind::real,
    -1,          2,
    kDesperate,  "below this worst quality, new bad tets are no reason to refuse"};
constexpr ParameterSpec kSmoothingLeastGain = {"least_gain",
                                               ParameterSpec::Kind::real,
                                               kQualityTolerance,
                                               1,
                                               2e-3,
                                               "least gain of the worst quality of the ball"};

constexpr std::array<ParameterSpec, 5> kSmoothingInside = {{
    {"laplacian", ParameterSpec::Kind::flag, 0, 1, 1, "try the mean of the neighbours first"},
    {"optimise", ParameterSpec::Kind::flag, 0, 1, 1,
     "then climb to the best place if bad tets remain"},
    kSmoothingDesperate,
    kSmoothingLeastGain,
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 6,
     "most directions that the optimisation follows"},
}};
constexpr std::array<ParameterSpec, 4> kSmoothingAtSurface = {{
    kSmoothingDesperate,
    kSmoothingLeastGain,
    {"halves", ParameterSpec::Kind::integer, 0, 20, 4, "how often a way that is refused is halved"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 12,
     "most directions that the optimisation follows"},
}};

}  // namespace

const OperatorInfo& smoothing_info() {
  static constexpr OperatorInfo kInfo = describe<Smoothing<Where::inside>>(
      "smoothing", TargetKind::vertex,
      "move a vertex: smart Laplacian, then optimisation of the worst tet", kSmoothingInside);
  return kInfo;
}

const OperatorInfo& surface_smoothing_info() {
  static constexpr OperatorInfo kInfo = describe<Smoothing<Where::at_surface>>(
      "surface_smoothing", TargetKind::vertex,
      "move a vertex of a surface that may change along it to the best place", kSmoothingAtSurface,
      true);
  return kInfo;
}

}  // namespace tetmend
