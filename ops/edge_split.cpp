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

#include "ops/relaxation.h"
#include "ops/shell_search.h"

namespace tetmend {

namespace {

class EdgeSplit final : public Operator {
 public:
  explicit EdgeSplit(const ParameterValues& values)
      : Operator(edge_split_info()),
        least_gain_(values.real("least_gain")),
        desperate_(static_cast<Quality>(values.real("desperate"))),
        relax_(values.flag("relax")),
        max_degree_(static_cast<unsigned>(values.integer("max_degree"))) {
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target) const override {
    const Verdict verdict = find_searchable_shell(context, target.edge(), context.scratch.shell);
    if (verdict != Verdict::accepted) return verdict;
    return context.scratch.shell.degree <= max_degree_ ? Verdict::accepted
                                                       : Verdict::not_applicable;
  }

  /// Places the vertex before it exists: the ball of the new vertex is the shell.
  Verdict evaluate(OperatorContext& context, Target) const override {
    const TetMesh& mesh = context.mesh;
    Scratch& scratch = context.scratch;
    const Shell& shell = scratch.shell;
    Quality floor = mesh.quality(shell.tets[0]);
    for (unsigned i = 1; i < shell.degree; ++i) {
      floor = std::min(floor, mesh.quality(shell.tets[i]));
    }
    // What is left to be gained by smoothing the neighbours is limited.
    constexpr double kRelaxedShare = 0.2;
    const double least = relax_            ? kRelaxedShare * std::max(floor, 0.0f)
                         : context.opening ? required_quality(context, floor)
                                           : floor + least_gain_;
    if (floor > 0 && is_hopeless(mesh, shell, least)) return Verdict::no_improvement;
    const Point& a = mesh.point(shell.a);
    const Point& b = mesh.point(shell.b);
    scratch.ball.clear();
    for (unsigned i = 0; i < shell.degree; ++i) {
      const Point& p = mesh.point(shell.ring[i]);
      const Point& q = mesh.point(shell.next(i));
      scratch.ball.add(a, q, p);
      scratch.ball.add(b, p, q);
    }
    scratch.point = 0.5 * (a + b);
    const double reached = scratch.ball.optimise(scratch.point, limits_);
    return reached > least ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction) const override {
    Scratch& scratch = context.scratch;
    const Shell& shell = scratch.shell;
    const VertexHandle v = transaction.add_vertex(scratch.point);
    if (!v.is_valid()) return Verdict::deferred;
    scratch.old_tets.assign(shell.tets.begin(), shell.tets.begin() + shell.degree);
    scratch.new_tets.clear();
    for (unsigned i = 0; i < shell.degree; ++i) {
      scratch.new_tets.push_back({shell.a, v, shell.ring[i], shell.next(i)});
      scratch.new_tets.push_back({v, shell.b, shell.ring[i], shell.next(i)});
    }
    const Verdict verdict =
        to_verdict(transaction.replace_cavity(scratch.old_tets, scratch.new_tets));
    if (verdict != Verdict::accepted) return verdict;
    if (relax_) relax(context, transaction, v, limits_);
    transaction.compare(scratch.before, scratch.now);
    // DEVIATION: beside the order of the quality vectors, which the attempt checks, the sum of (0.5
    // - q)^4 over the bad tets must fall, unless the worst tet is desperate.
    const bool worth_it = context.opening || is_worth_it(scratch.now, scratch.before, desperate_);
    return worth_it ? Verdict::accepted : Verdict::no_improvement;
  }

 private:
  /// Wherever the new vertex goes, the two tets at a ring edge share the angle that the old tet,
  /// which is positive, has there: one of them has half of it at most.
  static bool is_hopeless(const TetMesh& mesh, const Shell& shell, double least) {
    constexpr double kRounding = 1e-6;  // far more than there is
    const Point& a = mesh.point(shell.a);
    const Point& b = mesh.point(shell.b);
    // Largest cosine of an angle whose half has a sine of more than `least`.
    const double cosine = 1 - 2 * least * least * (1 - kRounding);
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
  Quality desperate_;
  bool relax_;
  unsigned max_degree_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 5> kParameters = {{
    {"least_gain", ParameterSpec::Kind::real, 0, 1, 1e-4,
     "least gain of the worst quality of the shell"},
    {"desperate", ParameterSpec::Kind::real, -1, 1, kDesperate,
     "below this worst quality, a gain of 0.001 pays for one more bad tet"},
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
