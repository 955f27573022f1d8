// SPDX-License-Identifier: MIT
// What operators that change the surface propose, and the edges that they are aimed at.
#pragma once

#include <vector>

#include "kernel/surface_shell.h"
#include "ops/operator.h"

namespace tetmend {

/// A proposal that may change the surface: tets to replace, and by what, with the labels.
struct SurfaceReplacement {
  std::vector<TetHandle> old_tets;
  std::vector<TetVertices> new_tets;
  std::vector<Label> labels;  ///< one for each new tet

  void clear() {
    old_tets.clear();
    new_tets.clear();
    labels.clear();
  }
  void add(const TetVertices& tet, Label label) {
    new_tets.push_back(tet);
    labels.push_back(label);
  }
  Verdict make(Transaction& transaction) const {
    return to_verdict(transaction.replace_at_surface(old_tets, new_tets, labels));
  }
};

/// `accepted` for an edge of a surface that may change, with two faces of it and a shell in the
/// worker's territory, which is left in `shell`.
inline Verdict find_surface_edge(const OperatorContext& context, TetEdge edge,
                                 SurfaceShell& shell) {
  const TetMesh& mesh = context.mesh;
  const auto [a, b] = mesh.vertices(edge);
  if (mesh.surface_guard() == nullptr || !mesh.is_fixed(a) || !mesh.is_fixed(b)) {
    return Verdict::constrained;
  }
  switch (find_surface_shell(mesh, edge, shell, context.workspace.territory())) {
    case ShellKind::closed:
      return Verdict::accepted;
    case ShellKind::boundary:
    case ShellKind::constrained:
      return Verdict::constrained;
    case ShellKind::too_large:
      return Verdict::not_applicable;
    case ShellKind::border:
      context.workspace.note_border();
      return Verdict::deferred;
  }
  return Verdict::not_applicable;
}

}  // namespace tetmend
