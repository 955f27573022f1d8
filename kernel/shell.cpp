// SPDX-License-Identifier: MIT
// Walks around edges.
#include "kernel/shell.h"

#include "kernel/star.h"
#include "kernel/workspace.h"

namespace tetmend {

namespace {

/// The two vertices off edge e, such that (edge, others) is an even permutation of 0..3.
constexpr std::array<std::array<std::uint8_t, 2>, 6> kOtherVertices = {
    {{2, 3}, {3, 1}, {1, 2}, {0, 3}, {2, 0}, {0, 1}}};

}  // namespace

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

ShellRange::ShellRange(const TetMesh& mesh, TetEdge edge) {
  const TetVertices& v = mesh.vertices(edge.tet());
  begin_.mesh_ = &mesh;
  begin_.current_ = begin_.first_ = edge;
  begin_.leave_ = v[kOtherVertices[edge.edge()][1]];
  // Walk the one way first: either it comes back here, or it ends at the boundary, and the range
  // starts there the other way.
  Iterator probe = begin_;
  TetEdge last = edge;
  for (; !(probe == std::default_sentinel); ++probe) last = *probe;
  const TetHandle t = last.tet();
  const auto [a, b] = mesh.vertices(edge);
  const TetVertices& w = mesh.vertices(t);
  begin_.current_ = begin_.first_ = last;
  // Of the two vertices off the edge, leave opposite the one that starts the ring order at the end
  // of the probe.
  const unsigned i = mesh.local_index(t, a);
  const unsigned j = mesh.local_index(t, b);
  const unsigned e = kEdgeOf[i][j];
  const bool same_sense = kEdgeVertices[e][0] == i;
  begin_.leave_ = w[kOtherVertices[e][same_sense ? 0 : 1]];
}

ShellRange::Iterator& ShellRange::Iterator::operator++() {
  const auto [a, b] = mesh_->vertices(current_);
  const TetHandle t = current_.tet();
  const HalfFace twin = mesh_->twin(HalfFace(t, mesh_->local_index(t, leave_)));
  if (twin.is_outside() || twin.tet() == first_.tet()) {
    mesh_ = nullptr;
    return *this;
  }
  // Crossed faces contain the edge and the vertex that is left behind next.
  for (const VertexHandle v : mesh_->vertices(t)) {
    if (v != a && v != b && v != leave_) {
      leave_ = v;
      break;
    }
  }
  current_ = *edge_in(*mesh_, twin.tet(), a, b);
  return *this;
}

}  // namespace tetmend
