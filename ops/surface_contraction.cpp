// SPDX-License-Identifier: MIT
#include "ops/surface_contraction.h"

#include <algorithm>
#include <limits>

#include "kernel/index_set.h"
#include "kernel/star.h"
#include "kernel/wanted_lengths.h"
#include "ops/surface_replacement.h"
#include "ops/surface_vertex.h"

namespace tetmend {

namespace {

struct Candidate {
  VertexHandle kept;
  std::vector<Quality> qualities;  // ascending, before smoothing
};

struct State {
  BallState ball;
  std::vector<VertexHandle> neighbours;
  IndexSet set;
  std::vector<Candidate> candidates;
  std::size_t count = 0;  // of them
  std::size_t next = 0;
  SurfaceReplacement replacement;
};

class SurfaceContraction final : public OperatorOf<State> {
 public:
  explicit SurfaceContraction(const ParameterValues& values)
      : OperatorOf(surface_contraction_info()),
        least_ratio_(values.real("least_ratio")),
        tries_(static_cast<std::size_t>(values.integer("tries"))) {
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    const VertexHandle v = target.vertex();
    const TetMesh& mesh = context.mesh;
    if (mesh.is_deleted(v) || !mesh.tet_of(v).is_valid()) return Verdict::not_applicable;
    if (!mesh.is_fixed(v)) return Verdict::not_applicable;
    return may_change(mesh, v) ? Verdict::accepted : Verdict::constrained;
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    const VertexHandle v = target.vertex();
    const StarKind kind = find_star(mesh, v, context.workspace, state.ball.link);
    if (kind != StarKind::whole) return to_verdict(kind);
    load_ball(mesh, state.ball.link, state.ball.ball);
    Quality worst_old = mesh.quality(state.ball.link[0].tet());
    for (const HalfFace f : state.ball.link) worst_old = std::min(worst_old, mesh.quality(f.tet()));
    list_neighbours(mesh, v, state);
    if (context.judge->looks_at_lengths()) keep_near(mesh, v, state.neighbours);
    state.count = state.next = 0;
    for (const VertexHandle w : state.neighbours) {
      // Smoothing can only raise the quality if the neighbour may move.
      const double share = may_change(mesh, w) ? least_ratio_ : 1;
      const double least =
          std::min(context.judge->floor(worst_old), share * static_cast<double>(worst_old));
      contract(mesh, w, std::max(least, 0.0), state);
    }
    std::sort(state.candidates.begin(),
              state.candidates.begin() + static_cast<std::ptrdiff_t>(state.count),
              [](const Candidate& x, const Candidate& y) {
                return x.qualities != y.qualities ? x.qualities > y.qualities : x.kept < y.kept;
              });
    return state.count > 0 ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target target, Transaction& transaction,
                State& state) const override {
    const TetMesh& mesh = context.mesh;
    const VertexHandle w = state.candidates[state.next].kept;
    if (state.next > 0) {  // the link was that of another vertex meanwhile
      const StarKind kind = find_star(mesh, target.vertex(), context.workspace, state.ball.link);
      if (kind != StarKind::whole) return to_verdict(kind);
    }
    state.replacement.clear();
    for (const HalfFace f : state.ball.link) {
      state.replacement.old_tets.push_back(f.tet());
      const auto [a, b, c] = mesh.vertices(f);
      if (a != w && b != w && c != w) state.replacement.add({w, a, b, c}, mesh.label(f.tet()));
    }
    const Verdict verdict = state.replacement.make(transaction);
    if (verdict != Verdict::accepted || context.judge->looks_at_lengths()) return verdict;
    // A refused move leaves the contraction as it is; the judge decides.
    climb_at_surface(context, transaction, w, limits_, state.ball);
    return Verdict::accepted;
  }

  bool propose_next(OperatorContext&, Target, State& state) const override {
    return ++state.next < std::min(state.count, tries_);
  }

 private:
  /// Of a vertex of a patch those along the surface, of one of a line those along the line.
  static void list_neighbours(const TetMesh& mesh, VertexHandle v, State& state) {
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
  static void keep_near(const TetMesh& mesh, VertexHandle v,
                        std::vector<VertexHandle>& neighbours) {
    const WantedLengths& wanted = *mesh.size_field()->wanted();
    std::erase_if(neighbours, [&](VertexHandle w) {
      return wanted.relative_length(mesh.point(v), mesh.point(w)) >= WantedLengths::kLeast;
    });
  }

  /// A candidate if each tet of the ball re-coned from w is above `least`.
  static void contract(const TetMesh& mesh, VertexHandle w, double least, State& state) {
    // The tets at the edge that goes have quality 0; one below refuses.
    constexpr double kLessThanZero = -std::numeric_limits<double>::min();
    if (state.ball.ball.worst_above(mesh.point(w), kLessThanZero) <= kLessThanZero) return;
    if (state.count == state.candidates.size()) state.candidates.emplace_back();
    Candidate& candidate = state.candidates[state.count];
    candidate.kept = w;
    candidate.qualities.clear();
    for (std::size_t i = 0; i < state.ball.link.size(); ++i) {
      const auto [a, b, c] = mesh.vertices(state.ball.link[i]);
      if (a == w || b == w || c == w) continue;
      const double q = state.ball.ball.quality(i);
      if (!(q > least)) return;
      candidate.qualities.push_back(static_cast<Quality>(q));
    }
    if (candidate.qualities.empty()) return;
    std::sort(candidate.qualities.begin(), candidate.qualities.end());
    ++state.count;
  }

  double least_ratio_;
  std::size_t tries_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 3> kParameters = {{
    {"least_ratio", ParameterSpec::Kind::real, 0, 1, 0.7,
     "least worst quality before smoothing, as a share of the old worst quality"},
    {"tries", ParameterSpec::Kind::integer, 1, 100, 3, "most neighbours that are tried"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 5,
     "most directions that the smoothing follows"},
}};

}  // namespace

const OperatorInfo& surface_contraction_info() {
  static const OperatorInfo kInfo = {
      "surface_contraction",
      TargetKind::vertex,
      "merge a vertex of a surface that may change into a neighbour there and smooth that",
      kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<SurfaceContraction>(values);
      },
      true};
  return kInfo;
}

}  // namespace tetmend
