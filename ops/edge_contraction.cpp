// SPDX-License-Identifier: MIT
//      q-----p              q-----p      The ball of v, as a picture in the plane: v goes to w. The
//     / \   / \            / '-.   \     tets at the edge vw vanish; every other one gets w for v.
//    /   \ /   \          /     '-. \    Then w moves to the best place in its new ball.
//   r-----v-----w   ->   r-----------w
//    \   / \   /          \     .-' /
//     \ /   \ /            \ .-'   /
//      s-----t              s-----t
#include "ops/edge_contraction.h"

#include <algorithm>
#include <limits>

#include "kernel/star.h"
#include "ops/smoothing.h"

namespace tetmend {

namespace {

class EdgeContraction final : public Operator {
 public:
  explicit EdgeContraction(const ParameterValues& values)
      : Operator(edge_contraction_info()), least_ratio_(values.real("least_ratio")) {
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
    Quality worst_old = mesh.quality(scratch.link[0].tet());
    for (const HalfFace f : scratch.link) worst_old = std::min(worst_old, mesh.quality(f.tet()));
    list_neighbours(mesh, scratch);

    scratch.kept_vertex = VertexHandle();
    for (const VertexHandle w : scratch.neighbours) {
      // Smoothing can only raise the quality if the neighbour may move.
      const double share = mesh.is_fixed(w) ? 1 : least_ratio_;
      const double least = context.opening ? required_quality(context, worst_old)
                                           : share * static_cast<double>(worst_old);
      if (!contract(mesh, w, std::max(least, 0.0), scratch)) continue;
      if (scratch.kept_vertex.is_valid() && !improves(scratch.qualities, scratch.best_qualities))
        continue;
      scratch.kept_vertex = w;
      std::swap(scratch.best_qualities, scratch.qualities);
    }
    return scratch.kept_vertex.is_valid() ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction) const override {
    const TetMesh& mesh = context.mesh;
    Scratch& scratch = context.scratch;
    const VertexHandle w = scratch.kept_vertex;
    scratch.old_tets.clear();
    scratch.new_tets.clear();
    for (const HalfFace f : scratch.link) {
      scratch.old_tets.push_back(f.tet());
      const auto [a, b, c] = mesh.vertices(f);
      if (a != w && b != w && c != w) scratch.new_tets.push_back({w, a, b, c});
    }
    const Verdict verdict =
        to_verdict(transaction.replace_cavity(scratch.old_tets, scratch.new_tets));
    if (verdict != Verdict::accepted || mesh.is_fixed(w)) return verdict;

    if (!collect_link(mesh, w, context.workspace, scratch.link)) return Verdict::deferred;
    load_ball(mesh, scratch.link, scratch.ball);
    scratch.point = mesh.point(w);
    const double start = scratch.ball.worst(scratch.point);
    if (start < limits_.enough &&
        scratch.ball.optimise_from(scratch.point, start, limits_) > start) {
      // A refused move leaves the contraction as it is; the check of the attempt decides.
      transaction.move_vertex(w, scratch.point, scratch.link);
    }
    return Verdict::accepted;
  }

 private:
  static void list_neighbours(const TetMesh& mesh, Scratch& scratch) {
    scratch.set.clear();
    scratch.neighbours.clear();
    for (const HalfFace f : scratch.link) {
      for (const VertexHandle w : mesh.vertices(f)) {
        if (scratch.set.insert(w.index())) scratch.neighbours.push_back(w);
      }
    }
  }

  /// Qualities (ascending) of the ball re-coned from w, into scratch.qualities. False as soon as
  /// one is not above `least`.
  static bool contract(const TetMesh& mesh, VertexHandle w, double least, Scratch& scratch) {
    // The tets at the edge that goes have quality 0; one below refuses.
    constexpr double kLessThanZero = -std::numeric_limits<double>::min();
    if (scratch.ball.worst_above(mesh.point(w), kLessThanZero) <= kLessThanZero) return false;
    scratch.qualities.clear();
    for (std::size_t i = 0; i < scratch.link.size(); ++i) {
      const auto [a, b, c] = mesh.vertices(scratch.link[i]);
      if (a == w || b == w || c == w) continue;
      const double q = scratch.ball.quality(i);
      if (!(q > least)) return false;
      scratch.qualities.push_back(static_cast<Quality>(q));
    }
    std::sort(scratch.qualities.begin(), scratch.qualities.end());
    return !scratch.qualities.empty();
  }

  double least_ratio_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 2> kParameters = {{
    {"least_ratio", ParameterSpec::Kind::real, 0, 1, 0.7,
     "least worst quality before smoothing, as a share of the old worst quality"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 5,
     "most directions that the smoothing follows"},
}};

}  // namespace

const OperatorInfo& edge_contraction_info() {
  static const OperatorInfo kInfo = {
      "edge_contraction", TargetKind::vertex,
      "merge a vertex into its best neighbour and smooth that", kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<EdgeContraction>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
