// SPDX-License-Identifier: MIT
// Walks around edges.
#include "kernel/shell.h"

#include "kernel/ring_walk.h"
#include "kernel/star.h"
#include "kernel/workspace.h"

namespace tetmend {

using ring_walk::first_turn;
using ring_walk::kOtherVertices;
using ring_walk::step;
using ring_walk::step_back;
using ring_walk::Turn;

ShellKind find_shell(const TetMesh& mesh, TetEdge edge, Shell& shell, const Territory& territory) {
  const TetVertices& first = mesh.vertices(edge.tet());
  const unsigned e = edge.edge();
  shell.a = first[kEdgeVertices[e][0]];
  shell.b = first[kEdgeVertices[e][1]];
  shell.degree = 0;
  if (mesh.is_constrained(edge)) return ShellKind::constrained;

  TetHandle t = edge.tet();
  unsigned leave = kOtherVertices[e][0];
  VertexHandle entered = first[kOtherVertices[e][0]];  // p_i
  VertexHandle ahead = first[kOtherVertices[e][1]];    // p_{i+1}
  do {
    if (shell.degree == kMaxDegree) return ShellKind::too_large;
    shell.ring[shell.degree] = entered;
    shell.tets[shell.degree] = t;
    ++shell.degree;
    const HalfFace face(t, leave);
    const HalfFace twin = mesh.twin(face);
    if (twin.is_outside()) return ShellKind::boundary;
    if (mesh.has_constraints(t) && (mesh.is_constrained(face) || mesh.is_frozen(t))) {
      return ShellKind::constrained;
    }
    t = twin.tet();
    entered = ahead;
    ahead = mesh.vertices(t)[twin.face()];
    if (!territory.holds(ahead)) return ShellKind::border;
    leave = mesh.local_index(t, entered);
  } while (t != edge.tet());
  return ShellKind::closed;
}

std::optional<TetEdge> find_edge(const TetMesh& mesh, VertexHandle a, VertexHandle b,
                                 Workspace& workspace, TetHandle hint) {
  if (hint.index() < mesh.tet_slots() && !mesh.is_deleted(hint)) {
    if (const auto edge = edge_in(mesh, hint, a, b)) return edge;
  }
  if (mesh.is_deleted(a) || !mesh.tet_of(a).is_valid()) return std::nullopt;
  return find_in_star(mesh, a, b, workspace);
}

Ring ring(const TetMesh& mesh, TetEdge e) {
  Ring found;
  if (mesh.is_deleted(e.tet())) return found;
  const auto [a, b] = mesh.vertices(e);
  found.a = a;
  found.b = b;
  Turn turn = first_turn(mesh, e);
  // An open ring begins at the boundary.
  while (step_back(mesh, turn) && turn.tet != e.tet()) {
  }
  const TetHandle first = turn.tet;
  do {
    found.tets.push_back(turn.tet);
    found.vertices.push_back(turn.from);
    if (step(mesh, turn)) continue;
    found.vertices.push_back(turn.to);
    return found;
  } while (turn.tet != first);
  found.closed = true;
  return found;
}

}  // namespace tetmend
