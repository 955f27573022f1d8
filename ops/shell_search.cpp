// SPDX-License-Identifier: MIT
#include "ops/shell_search.h"

#include <algorithm>

#include "kernel/workspace.h"

namespace tetmend {

Verdict find_searchable_shell(const OperatorContext& context, TetEdge edge, Shell& shell) {
  switch (find_shell(context.mesh, edge, shell, context.workspace.territory())) {
    case ShellKind::closed:
      break;
    case ShellKind::boundary:
    case ShellKind::constrained:
      return Verdict::constrained;
    case ShellKind::too_large:
      return Verdict::not_applicable;
    case ShellKind::border:
      context.workspace.note_border();
      return Verdict::deferred;
  }
  return shell.degree >= 3 && shell.degree <= kMaxSearchRing ? Verdict::accepted
                                                             : Verdict::not_applicable;
}

Verdict propose_covering(const OperatorContext& context, const Judge& judge, const Shell& shell,
                         ShellLocks locks, Core core, ShellState& state) {
  const TetMesh& mesh = context.mesh;
  auto& [old_tets, new_tets] = state.replacement;
  const unsigned m = shell.degree;
  std::array<Point, kMaxSearchRing> ring;
  std::array<Quality, kMaxSearchRing> sides;
  for (unsigned i = 0; i < m; ++i) {
    ring[i] = mesh.point(shell.ring[i]);
    sides[i] = mesh.quality(shell.tets[i]);
  }
  CoveringProblem problem;
  problem.standard = mesh.standard();
  problem.a = mesh.point(shell.a);
  problem.b = mesh.point(shell.b);
  problem.ring = {ring.data(), m};
  problem.old_sides = {sides.data(), m};
  problem.floor =
      static_cast<Quality>(judge.floor(*std::min_element(sides.begin(), sides.begin() + m)));
  problem.locked_vertices = locks.vertices;
  problem.locked_edges = locks.edges;
  problem.allow_core = core == Core::allowed;
  Covering covering;
  if (!state.search.run(problem, covering)) return Verdict::no_improvement;

  const auto is_ring_side = [m](unsigned i, unsigned j) { return j == (i + 1 == m ? 0 : i + 1); };
  list_new_tets(covering, shell.a, shell.b, shell.ring, is_ring_side, new_tets);
  old_tets.assign(shell.tets.begin(), shell.tets.begin() + m);
  for (unsigned n = 0; n < covering.degree; ++n) {
    const unsigned i = covering.core[n];
    if (is_ring_side(i, covering.core[n + 1 == covering.degree ? 0 : n + 1])) {
      std::erase(old_tets, shell.tets[i]);
    }
  }
  return may_raise_mean(mesh, judge, state.replacement) ? Verdict::accepted
                                                        : Verdict::no_improvement;
}

bool may_raise_mean(const TetMesh& mesh, const Judge& judge, const Replacement& replacement) {
  if (!judge.looks_at_mean()) return true;
  const auto ratio = [&mesh](const TetVertices& v) {
    return mean_ratio(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
  };
  const auto& [old_tets, new_tets] = replacement;
  double lacking = judge.usual() * static_cast<double>(new_tets.size());
  for (const TetHandle t : old_tets) lacking += ratio(mesh.vertices(t)) - judge.usual();
  auto left = static_cast<double>(new_tets.size());
  for (const TetVertices& tet : new_tets) {
    if (lacking >= left) return false;  // if all others were regular
    lacking -= ratio(tet);
    left -= 1;
  }
  return lacking < 0;
}

Verdict take_step(OperatorContext& context, const Judge& judge, const Replacement& replacement) {
  Transaction step(context.mesh, context.workspace);
  const Verdict verdict = replacement.make(step);
  if (verdict != Verdict::accepted) return verdict;
  if (!judge.accepts({step, context.states.comparison})) return Verdict::no_improvement;
  step.keep();
  return Verdict::accepted;
}

}  // namespace tetmend
