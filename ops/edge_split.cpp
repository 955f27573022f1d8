// SPDX-License-Identifier: MIT
//         b                   b          One tet (a, b, p, q) of the shell: the new vertex v on the
//       / | \               / | \        edge ab makes two of it, (a, v, p, q) and (v, b, p, q).
//     /   |   \           /   |   \      The shell becomes the ball of v, in which v then moves to
//   p . . | . . q  ->   p --- v --- q    the best place.
//     \   |   /           \   |   /
//       \ | /               \ | /
//         a                   a
#include "ops/edge_split.h"

#include <algorithm>
#include <cmath>

#include "kernel/wanted_lengths.h"
#include "ops/relaxation.h"

namespace tetmend {

namespace {

struct State {
  Shell shell;
  BallOptimiser ball;
  Point point = Point::Zero();  // of the new vertex
  Replacement replacement;
  RelaxationState relaxation;
};

class EdgeSplit final : public OperatorOf<State> {
 public:
  explicit EdgeSplit(const ParameterValues& values)
      : OperatorOf(edge_split_info(), Judge::fair({.desperate = values.real("desperate")})),
        least_gain_(values.real("least_gain")),
        relax_(values.flag("relax")),
        max_degree_(static_cast<unsigned>(values.integer("max_degree"))) {
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target, State& state) const override {
    const Verdict verdict = find_searchable_shell(context, target.edge(), state.shell);
    if (verdict != Verdict::accepted) return verdict;
    if (has_no_room(context)) return Verdict::no_improvement;
    return state.shell.degree <= max_degree_ ? Verdict::accepted : Verdict::not_applicable;
  }

  /// Places the vertex before it exists: the ball of the new vertex is the shell.
  Verdict evaluate(OperatorContext& context, Target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    const Shell& shell = state.shell;
    const Quality worst = worst_quality(mesh, shell);
    double least = context.judge->floor(worst, least_gain_);
    if (relax_) {
      // What is left to be gained by smoothing the neighbours is limited.
      constexpr double kRelaxedShare = 0.2;
      least = std::max(0.0, std::min(least, kRelaxedShare * worst));
    }
    if (worst > 0 && is_hopeless(mesh, shell, least)) return Verdict::no_improvement;
    const Point& a = mesh.point(shell.a);
    const Point& b = mesh.point(shell.b);
    state.ball.clear(mesh.standard());
    for (unsigned i = 0; i < shell.degree; ++i) {
      const Point& p = mesh.point(shell.ring[i]);
      const Point& q = mesh.point(shell.next(i));
      state.ball.add(a, q, p);
      state.ball.add(b, p, q);
    }
    state.point = 0.5 * (a + b);
    if (context.judge->looks_at_lengths()) {
      state.point = mesh.size_field()->wanted()->middle(a, b);
      if (state.ball.worst(state.point) > least) return Verdict::accepted;
    }
    const double reached = state.ball.optimise(state.point, limits_);
    return reached > least ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction,
                State& state) const override {
    const Shell& shell = state.shell;
    auto& [old_tets, new_tets] = state.replacement;
    const VertexHandle v = transaction.add_vertex(state.point);
    if (!v.is_valid()) return Verdict::deferred;
    old_tets.assign(shell.tets.begin(), shell.tets.begin() + shell.degree);
    new_tets.clear();
    for (unsigned i = 0; i < shell.degree; ++i) {
      new_tets.push_back({shell.a, v, shell.ring[i], shell.next(i)});
      new_tets.push_back({v, shell.b, shell.ring[i], shell.next(i)});
    }
    const Verdict verdict = state.replacement.make(transaction);
    if (verdict != Verdict::accepted) return verdict;
    if (relax_) relax(context, transaction, v, limits_, state.relaxation);
    return Verdict::accepted;
  }

 private:
  /// Wherever the new vertex goes, the two tets at a ring edge share the angle that the old tet,
  /// which is positive, has there: one of them has half of it at most.
  static bool is_hopeless(const TetMesh& mesh, const Shell& shell, double least) {
    constexpr double kRounding = 1e-6;  // far more than there is
    const Point& a = mesh.point(shell.a);
    const Point& b = mesh.point(shell.b);
    // Largest cosine of an angle whose half, which is acute, is of a quality above `least`.
    const double sine2 = least * least / mesh.standard().acute2();
    const double cosine = 1 - 2 * sine2 * (1 - kRounding);
    for (unsigned i = 0; i < shell.degree; ++i) {
      const Point& p = mesh.point(shell.ring[i]);
      const Point along = mesh.point(shell.next(i)) - p;
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

constexpr std::array<ParameterSpec, 5> kParameters = {{
    {"least_gain", ParameterSpec::Kind::real, 0, 1, 2e-4,
     "least gain of the worst quality of the shell"},
    {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
     "below this worst quality, a gain of 0.002 pays for one more bad tet"},
    {"relax", ParameterSpec::Kind::flag, 0, 1, 0,
     "smooth and reconnect around the new vertex before judging"},
    {"max_degree", ParameterSpec::Kind::integer, 3, kMaxSearchRing, 12,
     "largest shell that is split"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 8,
     "most directions that each placement follows"},
}};

}  // namespace

const OperatorInfo& edge_split_info() {
  static const OperatorInfo kInfo = {
      "edge_split", TargetKind::edge, "insert a vertex on an edge and smooth it", kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<EdgeSplit>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
