// SPDX-License-Identifier: MIT
//      q-----p              q-----p      The ball of v, as a picture in the plane: v goes to w. The
//     / \   / \            / '-.   \     tets at the edge vw vanish; every other one gets w for v.
//    /   \ /   \          /     '-. \    Then w moves to the best place in its new ball.
//   r-----v-----w   ->   r-----------w
//    \   / \   /          \     .-' /
//     \ /   \ /            \ .-'   /
//      s-----t              s-----t
#include <algorithm>
#include <limits>

#include "kernel/index_set.h"
#include "kernel/star.h"
#include "kernel/wanted_lengths.h"
#include "kernel/workspace.h"
#include "ops/builtin_operators.h"
#include "ops/vertex_ball.h"

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

/// A neighbour to merge into.
struct Candidate {
  VertexHandle kept;
  std::vector<Quality> qualities;  // ascending, before smoothing
};

struct ContractionState {
  BallState ball;
  std::vector<Near> near;
  std::vector<VertexHandle> neighbours;
  IndexSet set;
  std::vector<Candidate> candidates;  // the first `count`; the others are room
  std::size_t count = 0;
  std::size_t next = 0;  // to be tried
  bool halfway = false;  // both meet between their places
  std::vector<HalfFace> kept_link;
  LabelledReplacement replacement;
};

/// Target: a vertex. Tries to merge it into each neighbour, takes the neighbour with the best
/// quality vector, and smooths that neighbour unless it is fixed ([chen, 6.3]). Inside refuses
/// fixed vertices; at the surface merges a vertex of a patch into a neighbour on the surface, one
/// of a feature line into a neighbour on that line, and tries several neighbours. Under a judge of
/// lengths the neighbours are those that are too near, and stay where they are; where none will do, as
/// in a regular lattice, whose tets would become flat, the nearest comes halfway. Else a neighbour
/// that may move must promise a share of the worst quality of the ball, the `least_ratio`, before
/// it is smoothed. Cost: linear in ball size times neighbours.
template <Where At>
class EdgeContraction final : public OperatorOf<ContractionState> {
 public:
  explicit EdgeContraction(const ParameterValues& values)
      : OperatorOf(kInside ? edge_contraction_info() : surface_contraction_info()),
        least_ratio_(values.real("least_ratio")),
        tries_(kInside ? 1 : static_cast<std::size_t>(values.integer("tries"))) {
    limits_.steps = values.integer("steps");
  }

 protected:
  using State = ContractionState;

  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    return check_vertex(context.mesh, target.vertex(), At);
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    const VertexHandle v = target.vertex();
    const StarKind kind = find_star(mesh, v, context.workspace, state.ball.link);
    if (kind != StarKind::whole) return to_verdict(kind);
    load_ball(mesh, state.ball.link, state.ball.ball);
    Quality worst_old = mesh.quality(state.ball.link[0].tet());
    for (const HalfFace f : state.ball.link) worst_old = std::min(worst_old, mesh.quality(f.tet()));
    state.count = state.next = 0;
    state.halfway = false;
    const double floor = context.judge->floor(worst_old);
    if constexpr (kInside) {
      list_neighbours(mesh, state);
      if (context.judge->looks_at_mean()) return find_roundest(context, v, state);
      if (context.judge->looks_at_lengths()) {
        find_near(mesh, v, floor, state);
        return state.count > 0 ? Verdict::accepted : find_halfway(mesh, v, state);
      }
    } else {
      list_neighbours_on_surface(mesh, v, state);
      if (context.judge->looks_at_lengths()) leave_near(mesh, v, state.neighbours);
    }
    for (const VertexHandle w : state.neighbours) {
      // Smoothing can only raise the quality if the neighbour may move.
      const bool moves = kInside ? !mesh.is_fixed(w) : may_change(mesh, w);
      const double share = moves ? least_ratio_ : 1;
      consider(mesh, w, std::min(floor, share * static_cast<double>(worst_old)), state);
    }
    if constexpr (!kInside) {
      std::sort(state.candidates.begin(),
                state.candidates.begin() + static_cast<std::ptrdiff_t>(state.count),
                [](const Candidate& x, const Candidate& y) {
                  return x.qualities != y.qualities ? x.qualities > y.qualities : x.kept < y.kept;
                });
    }
    if (state.count == 0 && context.judge->looks_at_lengths()) return find_halfway(mesh, v, state);
    return state.count > 0 ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target target, Transaction& transaction,
                State& state) const override {
    const TetMesh& mesh = context.mesh;
    auto& link = state.ball.link;
    const VertexHandle w = state.candidates[state.next].kept;
    if (state.next > 0) {  // the link was that of another vertex meanwhile
      const StarKind kind = find_star(mesh, target.vertex(), context.workspace, link);
      if (kind != StarKind::whole) return to_verdict(kind);
    }
    if (state.halfway) {
      const Verdict verdict = come_halfway(context, target.vertex(), w, transaction, state);
      if (verdict != Verdict::accepted) return verdict;
    }
    state.replacement.clear();
    for (const HalfFace f : link) {
      state.replacement.old_tets.push_back(f.tet());
      const auto [a, b, c] = mesh.vertices(f);
      if (a != w && b != w && c != w) state.replacement.add({w, a, b, c}, mesh.label(f.tet()));
    }
    const Verdict verdict = state.replacement.make(transaction, At);
    if (verdict != Verdict::accepted || context.judge->looks_at_lengths()) return verdict;
    if (kInside && !mesh.is_fixed(w) &&
        find_star(mesh, w, context.workspace, link) == StarKind::border) {
      return Verdict::deferred;
    }
    // A refused move leaves the contraction as it is; the judge decides.
    climb(context, transaction, w, limits_, state.ball, At);
    return Verdict::accepted;
  }

  bool propose_next(OperatorContext&, Target, State& state) const override {
    return ++state.next < std::min(state.count, tries_);
  }

 private:
  static constexpr bool kInside = At == Where::inside;

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
      state.count = 0;
      next_candidate(state).kept = w;
      state.count = 1;
    }
    return state.count > 0 ? Verdict::accepted : Verdict::no_improvement;
  }

  /// The best neighbour, by its quality vector, of the nearest that are too near; no new edge may miss
  /// the wanted lengths by as much as the one that goes.
  static void find_near(const TetMesh& mesh, VertexHandle v, double least, State& state) {
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
      if (fits) consider(mesh, w, least, state);
    }
  }

  /// The nearest neighbour that is too near and may move.
  static Verdict find_halfway(const TetMesh& mesh, VertexHandle v, State& state) {
    const WantedLengths& wanted = *mesh.size_field()->wanted();
    Near nearest{WantedLengths::kLeast, VertexHandle()};
    for (const VertexHandle w : state.neighbours) {
      const bool moves = kInside ? !mesh.is_fixed(w) : may_come(mesh, v, w);
      const Near near{wanted.relative_length(mesh.point(v), mesh.point(w)), w};
      if (moves && near < nearest) nearest = near;
    }
    if (!nearest.vertex.is_valid()) return Verdict::no_improvement;
    next_candidate(state).kept = nearest.vertex;
    state.count = 1;
    state.halfway = true;
    return Verdict::accepted;
  }

  /// On the surface: along the patch or the line of both.
  static bool may_come(const TetMesh& mesh, VertexHandle v, VertexHandle w) {
    const SurfaceGuard& guard = *mesh.surface_guard();
    return may_change(mesh, w) && guard.place(w) == guard.place(v);
  }

  static Verdict come_halfway(OperatorContext& context, VertexHandle v, VertexHandle w,
                              Transaction& transaction, State& state) {
    const TetMesh& mesh = context.mesh;
    const StarKind kind = find_star(mesh, w, context.workspace, state.kept_link);
    if (kind != StarKind::whole) return to_verdict(kind);
    const Point place = mesh.size_field()->wanted()->middle(mesh.point(v), mesh.point(w));
    const VertexMove move{w, place, state.kept_link};
    return to_verdict(kInside ? transaction.move_vertices({&move, 1})
                              : transaction.move_at_surface({&move, 1}));
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

  /// Of a vertex of a patch those along the surface, of one of a line those along the line.
  static void list_neighbours_on_surface(const TetMesh& mesh, VertexHandle v, State& state) {
    const SurfaceGuard& guard = *mesh.surface_guard();
    const bool on_line = guard.place(v) == SurfacePlace::ridge;
    state.set.clear();
    state.neighbours.clear();
    for (const HalfFace opposite : state.ball.link) {
      for (unsigned k = 0; k < 4; ++k) {
        const HalfFace f(opposite.tet(), k);
        if (k == opposite.face() || !(mesh.is_boundary(f) || mesh.is_constrained(f))) continue;
        for (const VertexHandle w : mesh.vertices(f)) {
          if (w == v || !state.set.insert(w.index())) continue;
          if (!on_line || guard.is_feature(v, w)) state.neighbours.push_back(w);
        }
      }
    }
  }

  /// Leaves those that are nearer than wanted.
  static void leave_near(const TetMesh& mesh, VertexHandle v,
                         std::vector<VertexHandle>& neighbours) {
    const WantedLengths& wanted = *mesh.size_field()->wanted();
    std::erase_if(neighbours, [&](VertexHandle w) {
      return wanted.relative_length(mesh.point(v), mesh.point(w)) >= WantedLengths::kLeast;
    });
  }

  /// The place for one more candidate.
  static Candidate& next_candidate(State& state) {
    if (state.count == state.candidates.size()) state.candidates.emplace_back();
    return state.candidates[state.count];
  }

  /// Makes a neighbour a candidate if contract() finds it good enough. Inside, only the best stays
  /// one.
  static void consider(const TetMesh& mesh, VertexHandle w, double least, State& state) {
    Candidate& candidate = next_candidate(state);
    candidate.kept = w;
    if (!contract(mesh, w, std::max(least, 0.0), state.ball, candidate.qualities)) return;
    if (kInside && state.count == 1) {
      Candidate& best = state.candidates[0];
      if (improves(candidate.qualities, best.qualities)) std::swap(best, candidate);
    } else {
      ++state.count;
    }
  }

  /// Qualities (ascending) of the ball re-coned from w. False as soon as one is not above `least`.
  static bool contract(const TetMesh& mesh, VertexHandle w, double least, BallState& state,
                       std::vector<Quality>& qualities) {
    // The tets at the edge that goes have quality 0; one below refuses.
    constexpr double kLessThanZero = -std::numeric_limits<double>::min();
    if (state.ball.worst_above(mesh.point(w), kLessThanZero) <= kLessThanZero) return false;
    qualities.clear();
    for (std::size_t i = 0; i < state.link.size(); ++i) {
      const auto [a, b, c] = mesh.vertices(state.link[i]);
      if (a == w || b == w || c == w) continue;
      const double q = state.ball.quality(i);
      if (!(q > least)) return false;
      qualities.push_back(static_cast<Quality>(q));
    }
    std::sort(qualities.begin(), qualities.end());
    return !qualities.empty();
  }

  double least_ratio_;
  std::size_t tries_;
  BallOptimiser::Limits limits_;
};

constexpr ParameterSpec kContractionLeastRatio = {
    "least_ratio",
    ParameterSpec::Kind::real,
    0,
    1,
    0.7,
    "least worst quality before smoothing, as a share of the old worst quality"};
constexpr ParameterSpec kContractionSteps = {"steps", ParameterSpec::Kind::integer,
                                             1,       1000,
                                             5,       "most directions that the smoothing follows"};
constexpr std::array kContractionInside = {kContractionLeastRatio, kContractionSteps};
constexpr std::array kContractionAtSurface = {
    kContractionLeastRatio,
    ParameterSpec{"tries", ParameterSpec::Kind::integer, 1, 100, 3,
                  "most neighbours that are tried"},
    kContractionSteps};

}  // namespace

const OperatorInfo& edge_contraction_info() {
  static constexpr OperatorInfo kInfo = describe<EdgeContraction<Where::inside>>(
      "edge_contraction", TargetKind::vertex,
      "merge a vertex into its best neighbour and smooth that", kContractionInside);
  return kInfo;
}

const OperatorInfo& surface_contraction_info() {
  static constexpr OperatorInfo kInfo = describe<EdgeContraction<Where::at_surface>>(
      "surface_contraction", TargetKind::vertex,
      "merge a vertex of a surface that may change into a neighbour there and smooth that",
      kContractionAtSurface, true);
  return kInfo;
}

}  // namespace tetmend
