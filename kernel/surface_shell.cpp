// SPDX-License-Identifier: MIT
// Walks around edges of the surface.
#include "kernel/surface_shell.h"

#include <algorithm>

namespace tetmend {

namespace {

/// A face at an edge that a walk stops at.
enum class Stop : std::uint8_t { none, outside, labels, forbidden };

Stop stop_at(const TetMesh& mesh, HalfFace f) {
  const HalfFace twin = mesh.twin(f);
  if (twin.is_outside()) return Stop::outside;
  if (!mesh.is_constrained(f)) return Stop::none;
  return mesh.label(f.tet()) == mesh.label(twin.tet()) ? Stop::forbidden : Stop::labels;
}

/// Steps from tet to tet around (a, b).
struct Walk {
  const TetMesh& mesh;
  const Territory& territory;
  VertexHandle a, b;
  TetHandle tet;
  VertexHandle behind, ahead;  // the other two vertices

  HalfFace face_ahead() const { return {tet, mesh.local_index(tet, behind)}; }
  /// Through face_ahead(), which is inside. False: leaves the territory.
  bool step() {
    const HalfFace twin = mesh.twin(face_ahead());
    tet = twin.tet();
    behind = ahead;
    ahead = mesh.vertices(tet)[twin.face()];
    return territory.holds(ahead);
  }
  void turn_round() { std::swap(behind, ahead); }
};

/// From the tet of the walk on, which is the first of the side, to the face that ends it.
ShellKind walk_side(Walk& walk, ShellSide& side, Stop& stop) {
  side.count = 0;
  side.ring[0] = walk.behind;
  for (;;) {
    if (walk.mesh.is_frozen(walk.tet)) return ShellKind::constrained;
    if (side.count == kMaxDegree) return ShellKind::too_large;
    side.tets[side.count++] = walk.tet;
    side.ring[side.count] = walk.ahead;
    stop = stop_at(walk.mesh, walk.face_ahead());
    if (stop != Stop::none) return ShellKind::closed;
    if (side.tets[0] == walk.mesh.twin(walk.face_ahead()).tet()) return ShellKind::constrained;
    if (!walk.step()) return ShellKind::border;
  }
}

}  // namespace

ShellKind find_surface_shell(const TetMesh& mesh, TetEdge edge, SurfaceShell& shell,
                             const Territory& territory) {
  const TetVertices& first = mesh.vertices(edge.tet());
  const auto [i, j] = kEdgeVertices[edge.edge()];
  const auto [k, l] = kEdgeVertices[5 - edge.edge()];
  shell.a = first[i];
  shell.b = first[j];
  shell.side_count = 0;
  Walk walk{mesh, territory, shell.a, shell.b, edge.tet(), first[k], first[l]};
  // (i, j, k, l) is an even permutation of 0..3, but for the edges 1 and 4.
  const bool is_odd = edge.edge() == 1 || edge.edge() == 4;
  // Backwards to the face where the side begins, then from there.
  if (!is_odd) walk.turn_round();
  Stop begin{};
  ShellKind kind = walk_side(walk, shell.sides[0], begin);
  if (kind != ShellKind::closed) return kind;
  walk.turn_round();
  const HalfFace first_face(walk.tet, mesh.local_index(walk.tet, walk.ahead));
  Stop end{};
  kind = walk_side(walk, shell.sides[0], end);
  if (kind != ShellKind::closed) return kind;
  if (begin == Stop::forbidden || begin != end) return ShellKind::constrained;
  shell.side_count = 1;
  if (begin == Stop::outside) return ShellKind::closed;

  if (!walk.step()) return ShellKind::border;
  kind = walk_side(walk, shell.sides[1], end);
  if (kind != ShellKind::closed) return kind;
  shell.side_count = 2;
  const bool is_whole = end == Stop::labels && mesh.twin(walk.face_ahead()) == first_face;
  return is_whole ? ShellKind::closed : ShellKind::constrained;
}

}  // namespace tetmend
