// SPDX-License-Identifier: MIT
//     p_2 ------- p_1           The shell of an edge ab on the boundary, seen along it: the outer
//      |  \     /  |            faces (a, b, p_0) and (a, b, p_m) become (a, p_m, p_0) and
//      |    \ /    |     ->     (b, p_0, p_m). The tets are those of the best triangulation of the
//     p_m -- ab -- p_0          polygon p_0 ... p_m, above and below, as in edge removal.
#include <algorithm>

#include "kernel/surface_shell.h"
#include "ops/builtin_operators.h"
#include "ops/shell_search.h"
#include "ops/where.h"

namespace tetmend {

namespace {

struct SurfaceRemovalState {
  SurfaceShell shell;
  CoveringSearch search;
  Covering covering;
  std::vector<TetVertices> side_tets;
  LabelledReplacement replacement;
};

/// Target: an edge. Replaces the shell of an edge inside a patch by the best complete covering of
/// its open ring, as edge removal does inside: the two faces of the surface at the edge give way to
/// the two at the chord that closes the ring. Between two labels the shells of both sides have the
/// same chord. Refuses feature edges.
class SurfaceEdgeRemoval final : public OperatorOf<SurfaceRemovalState> {
 public:
  explicit SurfaceEdgeRemoval(const ParameterValues&) : OperatorOf(surface_edge_removal_info()) {}

 protected:
  using State = SurfaceRemovalState;

  Verdict precondition(const OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    const auto [a, b] = mesh.vertices(target.edge());
    const Verdict verdict = find_surface_edge(context, target.edge(), state.shell);
    if (verdict != Verdict::accepted) return verdict;
    if (mesh.is_constrained(target.edge()) || mesh.surface_guard()->is_feature(a, b)) {
      return Verdict::constrained;
    }
    for (unsigned s = 0; s < state.shell.side_count; ++s) {
      const unsigned count = state.shell.sides[s].count;
      if (count < 2 || count >= kMaxSearchRing) return Verdict::not_applicable;
    }
    return Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    const SurfaceShell& shell = state.shell;
    state.replacement.clear();
    Quality worst = std::numeric_limits<Quality>::infinity();
    for (unsigned s = 0; s < shell.side_count; ++s) {
      const auto tets = std::span(shell.sides[s].tets).first(shell.sides[s].count);
      worst = std::min(worst, worst_quality(mesh, tets));
      for (const TetHandle t : tets) state.replacement.old_tets.push_back(t);
    }
    const auto floor = static_cast<Quality>(context.judge->floor(worst));
    for (unsigned s = 0; s < shell.side_count; ++s) {
      if (!cover(mesh, shell.sides[s], floor, state)) return Verdict::no_improvement;
    }
    return Verdict::accepted;
  }

  Verdict apply(OperatorContext&, Target, Transaction& transaction, State& state) const override {
    return state.replacement.make(transaction, Where::at_surface);
  }

 private:
  /// The best covering of a side, as new tets; false if there is none above the floor.
  static bool cover(const TetMesh& mesh, const ShellSide& side, Quality floor, State& state) {
    const unsigned m = side.count + 1;
    std::array<Point, kMaxSearchRing> ring;
    std::array<Quality, kMaxSearchRing> none{};  // of the core, which there is not
    for (unsigned i = 0; i < m; ++i) ring[i] = mesh.point(side.ring[i]);
    CoveringProblem problem;
    problem.standard = mesh.standard();
    problem.a = mesh.point(state.shell.a);
    problem.b = mesh.point(state.shell.b);
    problem.ring = {ring.data(), m};
    problem.old_sides = {none.data(), m};
    problem.floor = floor;
    problem.allow_core = false;
    if (!state.search.run(problem, state.covering)) return false;
    list_new_tets(
        state.covering, state.shell.a, state.shell.b, side.ring,
        [](unsigned, unsigned) { return false; }, state.side_tets);
    for (const TetVertices& tet : state.side_tets) {
      state.replacement.add(tet, mesh.label(side.tets[0]));
    }
    return true;
  }
};

}  // namespace

const OperatorInfo& surface_edge_removal_info() {
  static constexpr OperatorInfo kInfo = describe<SurfaceEdgeRemoval>(
      "surface_edge_removal", TargetKind::edge,
      "remove an edge of a surface that may change: best triangulation of its open ring");
  return kInfo;
}

}  // namespace tetmend
