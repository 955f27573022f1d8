// SPDX-License-Identifier: MIT
// From a shell of the mesh to a covering search and back: what all operators on edges share.
#pragma once

#include <optional>

#include "ops/operator.h"
#include "search/covering_search.h"
#include "search/shell_locks.h"

namespace tetmend {

/// `accepted` for a closed shell in the worker's territory that is small enough to be searched; the
/// shell is left in `shell`.
Verdict find_searchable_shell(const OperatorContext& context, TetEdge edge, Shell& shell);

/// What each new tet of an attempt on a shell must exceed, see required_quality().
Quality required_floor(const OperatorContext& context, const Shell& shell);

/// Searches the best covering of a shell and leaves old and new tets in the scratch. `accepted`
/// only if there is one of which every new tet is better than `floor`, which is, if not given, the
/// worst old tet.
Verdict propose_covering(OperatorContext& context, const Shell& shell, ShellLocks locks,
                         bool allow_core, std::optional<Quality> floor = {});

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
