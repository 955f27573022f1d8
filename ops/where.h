// SPDX-License-Identifier: MIT
// What a class needs that works inside and at a surface that may change, as two operators.
#pragma once

#include <vector>

#include "kernel/surface_guard.h"
#include "kernel/surface_shell.h"
#include "kernel/workspace.h"
#include "ops/operator.h"

namespace tetmend {

/// Of an operator: inside it leaves the surface alone, at the surface it works on nothing else.
enum class Where : bool { inside, at_surface };

/// May move, or vanish into a neighbour: it lies on a patch or a feature line that may change.
inline bool may_change(const TetMesh& mesh, VertexHandle v) {
  const SurfaceGuard* guard = mesh.surface_guard();
  if (guard == nullptr || mesh.is_frozen(v) || mesh.is_required(v)) return false;
  const SurfacePlace place = guard->place(v);
  return place == SurfacePlace::smooth || place == SurfacePlace::ridge;
}

/// `accepted` for a vertex that an operator there may move or remove.
inline Verdict check_vertex(const TetMesh& mesh, VertexHandle v, Where where) {
  if (mesh.is_deleted(v) || !mesh.tet_of(v).is_valid()) return Verdict::not_applicable;
  if (where == Where::inside) return mesh.is_fixed(v) ? Verdict::constrained : Verdict::accepted;
  if (!mesh.is_fixed(v)) return Verdict::not_applicable;
  return may_change(mesh, v) ? Verdict::accepted : Verdict::constrained;
}

/// A proposal of tets to replace, and by what, with the labels that a changed surface needs.
struct LabelledReplacement {
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
  Verdict make(Transaction& transaction, Where where) const {
    return to_verdict(where == Where::inside
                          ? transaction.replace_cavity(old_tets, new_tets)
                          : transaction.replace_at_surface(old_tets, new_tets, labels));
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
