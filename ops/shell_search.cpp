// SPDX-License-Identifier: MIT
#include "ops/shell_search.h"

#include <algorithm>

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

Quality required_floor(const OperatorContext& context, const Shell& shell) {
  Quality worst = context.mesh.quality(shell.tets[0]);
  for (unsigned i = 1; i < shell.degree; ++i) {
    worst = std::min(worst, context.mesh.quality(shell.tets[i]));
  }
  return static_cast<Quality>(required_quality(context, worst));
}

Verdict propose_covering(OperatorContext& context, const Shell& shell, ShellLocks locks,
                         bool allow_core, std::optional<Quality> floor) {
  const TetMesh& mesh = context.mesh;
  Scratch& scratch = context.scratch;
  const unsigned m = shell.degree;
  std::array<Point, kMaxSearchRing> ring;
  std::array<Quality, kMaxSearchRing> sides;
  for (unsigned i = 0; i < m; ++i) {
    ring[i] = mesh.point(shell.ring[i]);
    sides[i] = mesh.quality(shell.tets[i]);
  }
  CoveringProblem problem;
  problem.a = mesh.point(shell.a);
  problem.b = mesh.point(shell.b);
  problem.ring = {ring.data(), m};
  problem.old_sides = {sides.data(), m};
  problem.floor = floor.value_or(*std::min_element(sides.begin(), sides.begin() + m));
  problem.locked_vertices = locks.vertices;
  problem.locked_edges = locks.edges;
  problem.allow_core = allow_core;
  Covering covering;
  if (!scratch.search.run(problem, covering)) return Verdict::no_improvement;

  const auto is_ring_side = [m](unsigned i, unsigned j) { return j == (i + 1 == m ? 0 : i + 1); };
  list_new_tets(covering, shell.a, shell.b, shell.ring, is_ring_side, scratch.new_tets);
  scratch.old_tets.assign(shell.tets.begin(), shell.tets.begin() + m);
  for (unsigned n = 0; n < covering.degree; ++n) {
    const unsigned i = covering.core[n];
    if (is_ring_side(i, covering.core[n + 1 == covering.degree ? 0 : n + 1])) {
      std::erase(scratch.old_tets, shell.tets[i]);
    }
  }
  return Verdict::accepted;
}

}  // namespace tetmend
