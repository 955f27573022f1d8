// SPDX-License-Identifier: MIT
//         b                   b          One tet (a, b, p, q) of the shell: the new vertex v on the
//       / | \               / | \        edge ab makes two of it, (a, v, p, q) and (v, b, p, q).
//     /   |   \           /   |   \      The shell becomes the ball of v, in which v then moves to
//   p . . | . . q  ->   p --- v --- q    the best place.
//     \   |   /           \   |   /
//       \ | /               \ | /
//         a                   a
#include <algorithm>
#include <cmath>

#include "kernel/wanted_lengths.h"
#include "ops/builtin_operators.h"
#include "ops/relaxation.h"

namespace tetmend {

namespace {

/// A tet (a, b, p, q) at the edge ab.
struct TetAtEdge {
  TetHandle tet;
  VertexHandle p, q;
};

struct SplitState {
  Shell shell;                 // inside
  SurfaceShell surface_shell;  // at the surface
  VertexHandle a, b;
  std::vector<TetAtEdge> tets;
  BallOptimiser ball;
  Point point = Point::Zero();  // of the new vertex
  LabelledReplacement replacement;
  RelaxationState relaxation;
};

/// Target: an edge. Puts a vertex at its midpoint, splits the tets of its shell and moves the
/// vertex to where the worst new tet is best ([chen, 6.3]): inside in any direction, at the
/// surface along that or, from a feature edge, along its line. Under a judge of lengths a vertex
/// inside stays in the middle, by wanted lengths, if no tet is too bad there. With `relax`, the
/// tets around the new vertex are then reconnected and its neighbours smoothed before the outcome
/// is judged. Refuses edges of the other kind, and splits that pay for a better worst tet with
/// many new bad ones, so that the mesh does not grow for nothing. Cost: the smoothing of one
/// vertex, with `relax` of about 30 and of their shells.
template <Where At>
class EdgeSplit final : public OperatorOf<SplitState> {
 public:
  explicit EdgeSplit(const ParameterValues& values)
      : OperatorOf(At == Where::inside ? edge_split_info() : surface_split_info(),
                   Judge::fair({.desperate = values.real("desperate")})),
        least_gain_(values.real("least_gain")),
        relax_(values.flag("relax")),
        max_degree_(static_cast<unsigned>(values.integer("max_degree"))) {
    limits_.steps = values.integer("steps");
  }

 protected:
  using State = SplitState;

  Verdict precondition(const OperatorContext& context, Target target, State& state) const override {
    const Verdict verdict = list_tets(context, target.edge(), state);
    if (verdict != Verdict::accepted) return verdict;
    if (At == Where::inside && has_no_room(context)) return Verdict::no_improvement;
    return state.tets.size() <= max_degree_ ? Verdict::accepted : Verdict::not_applicable;
  }

  /// Places the vertex before it exists: the ball of the new vertex is the shell.
  Verdict evaluate(OperatorContext& context, Target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    Quality worst = mesh.quality(state.tets[0].tet);
    for (const TetAtEdge& at : state.tets) worst = std::min(worst, mesh.quality(at.tet));
    double least = context.judge->floor(worst, least_gain_);
    if (relax_) {
      // What is left to be gained by smoothing the neighbours is limited.
      constexpr double kRelaxedShare = 0.2;
      least = std::max(0.0, std::min(least, kRelaxedShare * worst));
    }
    if (worst > 0 && is_hopeless(mesh, state, least)) return Verdict::no_improvement;
    const Point& a = mesh.point(state.a);
    const Point& b = mesh.point(state.b);
    state.ball.clear(mesh.standard());
    for (const TetAtEdge& at : state.tets) {
      const Point& p = mesh.point(at.p);
      const Point& q = mesh.point(at.q);
      state.ball.add(a, q, p);
      state.ball.add(b, p, q);
    }
    state.point = 0.5 * (a + b);
    if (At == Where::at_surface) return place_along_surface(mesh, least, state);
    if (context.judge->looks_at_lengths()) {
      state.point = mesh.size_field()->wanted()->middle(a, b);
      if (state.ball.worst(state.point) > least) return Verdict::accepted;
    }
    const double reached = state.ball.optimise(state.point, limits_);
    return reached > least ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction,
                State& state) const override {
    const VertexHandle v = transaction.add_vertex(state.point);
    if (!v.is_valid()) return Verdict::deferred;
    state.replacement.clear();
    for (const auto& [tet, p, q] : state.tets) {
      const Label label = context.mesh.label(tet);
      state.replacement.old_tets.push_back(tet);
      state.replacement.add({state.a, v, p, q}, label);
      state.replacement.add({v, state.b, p, q}, label);
    }
    const Verdict verdict = state.replacement.make(transaction, At);
    if (verdict != Verdict::accepted) return verdict;
    if (relax_) {
      relax(context, transaction, v, limits_, state.relaxation, At);
    } else if (At == Where::at_surface) {
      climb(context, transaction, v, limits_, state.relaxation.ball, At);
    }
    return Verdict::accepted;
  }

 private:
  static Verdict list_tets(const OperatorContext& context, TetEdge edge, State& state) {
    state.tets.clear();
    if constexpr (At == Where::inside) {
      Shell& shell = state.shell;
      const Verdict verdict = find_searchable_shell(context, edge, shell);
      if (verdict != Verdict::accepted) return verdict;
      state.a = shell.a;
      state.b = shell.b;
      for (unsigned i = 0; i < shell.degree; ++i) {
        state.tets.push_back({shell.tets[i], shell.ring[i], shell.next(i)});
      }
    } else {
      SurfaceShell& shell = state.surface_shell;
      const Verdict verdict = find_surface_edge(context, edge, shell);
      if (verdict != Verdict::accepted) return verdict;
      state.a = shell.a;
      state.b = shell.b;
      for (const ShellSide& side : std::span(shell.sides).first(shell.side_count)) {
        for (unsigned i = 0; i < side.count; ++i) {
          state.tets.push_back({side.tets[i], side.ring[i], side.ring[i + 1]});
        }
      }
    }
    return Verdict::accepted;
  }

  /// Only looks how good the tets can become: a new vertex starts in the middle, where the guard of
  /// the surface knows its place, and climbs from there.
  Verdict place_along_surface(const TetMesh& mesh, double least, State& state) const {
    const OnLineOrPlane restriction = restrict(mesh, state.surface_shell, state.point);
    state.ball.restrict_to(restriction);
    Point place = state.point;
    const double reached = state.ball.optimise(place, limits_);
    return reached > least ? Verdict::accepted : Verdict::no_improvement;
  }

  /// The line of a feature edge; else the plane of the two faces of the surface at the edge, or one
  /// between them.
  static OnLineOrPlane restrict(const TetMesh& mesh, const SurfaceShell& shell,
                                const Point& middle) {
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

  /// Wherever the new vertex goes, the two tets at a ring edge share the angle that the old tet,
  /// which is positive, has there: one of them has half of it at most.
  static bool is_hopeless(const TetMesh& mesh, const State& state, double least) {
    if (mesh.standard().is_own()) return false;  // that says nothing of angles
    constexpr double kRounding = 1e-6;           // far more than there is
    const Point& a = mesh.point(state.a);
    const Point& b = mesh.point(state.b);
    // Largest cosine of an angle whose half, which is acute, is of a quality above `least`.
    const double sine2 = least * least / mesh.standard().acute2();
    const double cosine = 1 - 2 * sine2 * (1 - kRounding);
    for (const TetAtEdge& at : state.tets) {
      const Point& p = mesh.point(at.p);
      const Point along = mesh.point(at.q) - p;
      const Point towards_a = along.cross(a - p);
      const Point towards_b = along.cross(b - p);
      const double scale = std::sqrt(towards_a.squaredNorm() * towards_b.squaredNorm());
      if (towards_a.dot(towards_b) > cosine * scale) return true;
    }
    return false;
  }

  double least_gain_;
  bool relax_;
  unsigned max_degree_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 5> split_parameters(int relax,
                                                        const ParameterSpec& max_degree) {
  return {{
      {"least_gain", ParameterSpec::Kind::real, 0, 1, 2e-4,
       "least gain of the worst quality of the shell"},
      {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
       "below this worst quality, a gain of 0.002 pays for one more bad tet"},
      {"relax", ParameterSpec::Kind::flag, 0, 1, static_cast<double>(relax),
       "smooth and reconnect around the new vertex before judging"},
      max_degree,
      {"steps", ParameterSpec::Kind::integer, 1, 1000, 8,
       "most directions that each placement follows"},
  }};
}

constexpr auto kSplitInside =
    split_parameters(0, {"max_degree", ParameterSpec::Kind::integer, 3, kMaxSearchRing, 12,
                         "largest shell that is split"});
constexpr auto kSplitAtSurface =
    split_parameters(1, {"max_degree", ParameterSpec::Kind::integer, 1, 2 * kMaxDegree, 16,
                         "most tets at an edge that is split"});

}  // namespace

const OperatorInfo& edge_split_info() {
  static constexpr OperatorInfo kInfo = describe<EdgeSplit<Where::inside>>(
      "edge_split", TargetKind::edge, "insert a vertex on an edge and smooth it", kSplitInside);
  return kInfo;
}

const OperatorInfo& surface_split_info() {
  static constexpr OperatorInfo kInfo = describe<EdgeSplit<Where::at_surface>>(
      "surface_split", TargetKind::edge,
      "insert a vertex on an edge of a surface that may change and smooth it there",
      kSplitAtSurface);
  return kInfo;
}

}  // namespace tetmend
