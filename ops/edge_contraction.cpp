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

#include "kernel/index_set.h"
#include "kernel/star.h"
#include "kernel/wanted_lengths.h"
#include "ops/smoothing.h"

namespace tetmend {

namespace {

/// A neighbour that is nearer than wanted.
struct Near {
  double length;  // relative
  VertexHandle vertex;
  friend bool operator<(const Near& x, const Near& y) {
    return x.length != y.length ? x.length < y.length : x.vertex < y.vertex;
  }
};

struct State {
  BallState ball;
  std::vector<Near> near;
  VertexHandle kept_vertex;
  std::vector<VertexHandle> neighbours;
  IndexSet set;
  std::vector<Quality> qualities;
  std::vector<Quality> best_qualities;
  Replacement replacement;
};

class EdgeContraction final : public OperatorOf<State> {
 public:
  explicit EdgeContraction(const ParameterValues& values)
      : OperatorOf(edge_contraction_info()), least_ratio_(values.real("least_ratio")) {
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
    const VertexHandle v = target.vertex();
    const StarKind kind = find_star(mesh, v, context.workspace, state.ball.link);
    if (kind != StarKind::whole) return to_verdict(kind);
    load_ball(mesh, state.ball.link, state.ball.ball);
    Quality worst_old = mesh.quality(state.ball.link[0].tet());
    for (const HalfFace f : state.ball.link) worst_old = std::min(worst_old, mesh.quality(f.tet()));
    list_neighbours(mesh, state);

    state.kept_vertex = VertexHandle();
    if (context.judge->looks_at_mean()) return find_roundest(context, v, state);
    if (context.judge->looks_at_lengths()) {
      return find_near(mesh, v, context.judge->floor(worst_old), state);
    }
    for (const VertexHandle w : state.neighbours) {
      // Smoothing can only raise the quality if the neighbour may move.
      const double share = mesh.is_fixed(w) ? 1 : least_ratio_;
      const double least =
          std::min(context.judge->floor(worst_old), share * static_cast<double>(worst_old));
      if (!contract(mesh, w, std::max(least, 0.0), state)) continue;
      if (state.kept_vertex.is_valid() && !improves(state.qualities, state.best_qualities))
        continue;
      state.kept_vertex = w;
      std::swap(state.best_qualities, state.qualities);
    }
    return state.kept_vertex.is_valid() ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction,
                State& state) const override {
    const TetMesh& mesh = context.mesh;
    const VertexHandle w = state.kept_vertex;
    state.replacement.old_tets.clear();
    state.replacement.new_tets.clear();
    for (const HalfFace f : state.ball.link) {
      state.replacement.old_tets.push_back(f.tet());
      const auto [a, b, c] = mesh.vertices(f);
      if (a != w && b != w && c != w) state.replacement.new_tets.push_back({w, a, b, c});
    }
    const Verdict verdict = state.replacement.make(transaction);
    if (verdict != Verdict::accepted || mesh.is_fixed(w) || context.judge->looks_at_lengths()) {
      return verdict;
    }
    const StarKind kind = find_star(mesh, w, context.workspace, state.ball.link);
    if (kind == StarKind::border) return Verdict::deferred;
    // A refused move leaves the contraction as it is; the judge decides.
    climb(context, transaction, w, limits_, state.ball);
    return Verdict::accepted;
  }

 private:
  /// The neighbour with which the mean of the mean ratios rises most, of the nearest.
  Verdict find_roundest(const OperatorContext& context, VertexHandle v, State& state) const {
    constexpr std::size_t kNearest = 5;
    const TetMesh& mesh = context.mesh;
    const Point& place = mesh.point(v);
    const auto nearer = [&](VertexHandle x, VertexHandle y) {
      return (mesh.point(x) - place).squaredNorm() < (mesh.point(y) - place).squaredNorm();
    };
    if (state.neighbours.size() > kNearest) {
      std::nth_element(state.neighbours.begin(), state.neighbours.begin() + kNearest,
                       state.neighbours.end(), nearer);
      state.neighbours.resize(kNearest);
    }
    std::sort(state.neighbours.begin(), state.neighbours.end());
    const double usual = context.judge->usual();
    double before = 0;
    for (const HalfFace f : state.ball.link) before += round(mesh, f, place) - usual;
    // What smoothing of the neighbour may add.
    constexpr double kSmoothed = 0.05;
    double best = before - kSmoothed * static_cast<double>(state.ball.link.size());
    for (const VertexHandle w : state.neighbours) {
      constexpr double kLessThanZero = -std::numeric_limits<double>::min();
      const Point& to = mesh.point(w);
      if (state.ball.ball.worst_above(to, kLessThanZero) <= kLessThanZero) continue;
      double now = 0;
      for (const HalfFace f : state.ball.link) {
        const auto [a, b, c] = mesh.vertices(f);
        if (a != w && b != w && c != w) now += round(mesh, f, to) - usual;
      }
      if (now <= best) continue;
      best = now;
      state.kept_vertex = w;
    }
    return state.kept_vertex.is_valid() ? Verdict::accepted : Verdict::no_improvement;
  }
  /// The best neighbour, by its quality vector, of the nearest that are too near; no new edge may miss
  /// the wanted lengths by as much as the one that goes.
  static Verdict find_near(const TetMesh& mesh, VertexHandle v, double least, State& state) {
    constexpr std::size_t kNearest = 5;
    const WantedLengths& wanted = *mesh.size_field()->wanted();
    const Point& place = mesh.point(v);
    state.near.clear();
    for (const VertexHandle w : state.neighbours) {
      const double length = wanted.relative_length(place, mesh.point(w));
      if (length < WantedLengths::kLeast) state.near.push_back({length, w});
    }
    std::sort(state.near.begin(), state.near.end());
    if (state.near.size() > kNearest) state.near.resize(kNearest);
    for (const auto& [length, w] : state.near) {
      const Point& to = mesh.point(w);
      const double fit = WantedLengths::fit(length);
      const bool fits =
          std::all_of(state.neighbours.begin(), state.neighbours.end(), [&, w = w](VertexHandle x) {
            return x == w || WantedLengths::fit(wanted.relative_length(to, mesh.point(x))) > fit;
          });
      if (!fits || !contract(mesh, w, std::max(least, 0.0), state)) continue;
      if (state.kept_vertex.is_valid() && !improves(state.qualities, state.best_qualities)) {
        continue;
      }
      state.kept_vertex = w;
      std::swap(state.best_qualities, state.qualities);
    }
    return state.kept_vertex.is_valid() ? Verdict::accepted : Verdict::no_improvement;
  }
  static double round(const TetMesh& mesh, HalfFace f, const Point& point) {
    const auto [a, b, c] = mesh.vertices(f);
    return mean_ratio(point, mesh.point(a), mesh.point(b), mesh.point(c));
  }
  static void list_neighbours(const TetMesh& mesh, State& state) {
    state.set.clear();
    state.neighbours.clear();
    for (const HalfFace f : state.ball.link) {
      for (const VertexHandle w : mesh.vertices(f)) {
        if (state.set.insert(w.index())) state.neighbours.push_back(w);
      }
    }
  }

  /// Qualities (ascending) of the ball re-coned from w, into state.qualities. False as soon as
  /// one is not above `least`.
  static bool contract(const TetMesh& mesh, VertexHandle w, double least, State& state) {
    // The tets at the edge that goes have quality 0; one below refuses.
    constexpr double kLessThanZero = -std::numeric_limits<double>::min();
    if (state.ball.ball.worst_above(mesh.point(w), kLessThanZero) <= kLessThanZero) return false;
    state.qualities.clear();
    for (std::size_t i = 0; i < state.ball.link.size(); ++i) {
      const auto [a, b, c] = mesh.vertices(state.ball.link[i]);
      if (a == w || b == w || c == w) continue;
      const double q = state.ball.ball.quality(i);
      if (!(q > least)) return false;
      state.qualities.push_back(static_cast<Quality>(q));
    }
    std::sort(state.qualities.begin(), state.qualities.end());
    return !state.qualities.empty();
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
