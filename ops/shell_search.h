// SPDX-License-Identifier: MIT
// From a shell of the mesh to a covering search and back: what all operators on edges share.
#pragma once

#include "kernel/shell.h"
#include "ops/operator.h"
#include "search/covering_search.h"
#include "search/shell_locks.h"

namespace tetmend {

/// `accepted` for a closed shell in the worker's territory that is small enough to be searched; the
/// shell is left in `shell`.
Verdict find_searchable_shell(const OperatorContext& context, TetEdge edge, Shell& shell);

/// What operators on shells remember.
struct ShellState {
  Shell shell;
  CoveringSearch search;
  Replacement replacement;
};

inline Quality worst_quality(const TetMesh& mesh, const Shell& shell) {
  return worst_quality(mesh, std::span(shell.tets).first(shell.degree));
}

/// Whether a covering may leave a part of the ring without triangles.
enum class Core : bool { refused, allowed };

/// Searches the best covering of a shell, which need not be that of the state, and leaves it in the
/// replacement of the state. `accepted` only if there is one of which every new tet is above the
/// floor of the judge.
Verdict propose_covering(const OperatorContext& context, const Judge& judge, const Shell& shell,
                         ShellLocks locks, Core core, ShellState& state);

/// False where a judge of the mean would refuse a replacement, which is cheaper than to make it and
/// to undo it. True for other judges. Cost: a mean ratio for each tet, at most.
bool may_raise_mean(const TetMesh& mesh, const Judge& judge, const Replacement& replacement);

/// Makes a replacement as a step of a larger change, and keeps it if the judge accepts.
Verdict take_step(OperatorContext& context, const Judge& judge, const Replacement& replacement);

/// Writes the tets of a covering: upper and lower tets of each triangle, then the sides of the core
/// that are new. `is_old_side(i)` tells which ring sides of the core stay as they are.
template <class Ring, class IsOldSide>
void list_new_tets(const Covering& covering, VertexHandle a, VertexHandle b, const Ring& ring,
                   IsOldSide&& is_old_side, std::vector<TetVertices>& out) {
  out.clear();
  for (unsigned n = 0; n < covering.triangle_count; ++n) {
    const auto& [i, k, j] = covering.triangles[n];
    out.push_back({a, ring[i], ring[k], ring[j]});
    out.push_back({ring[i], ring[k], ring[j], b});
  }
  for (unsigned n = 0; n < covering.degree; ++n) {
    const unsigned i = covering.core[n];
    const unsigned j = covering.core[n + 1 == covering.degree ? 0 : n + 1];
    if (!is_old_side(i, j)) out.push_back({a, b, ring[i], ring[j]});
  }
}

}  // namespace tetmend
