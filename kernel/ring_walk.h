// SPDX-License-Identifier: MIT
// Steps from tet to tet around an edge: for sources of walks.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/tet_mesh.h"

namespace tetmend::ring_walk {

/// The two vertices off edge e, such that (edge, others) is an even permutation of 0..3.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> kOtherVertices = {
    {{2, 3}, {3, 1}, {1, 2}, {0, 3}, {2, 0}, {0, 1}}};

/// The tet at hand of a walk around an edge: (a, b, from, to), positive.
struct Turn {
  TetHandle tet;
  VertexHandle from;
  VertexHandle to;
};

inline Turn first_turn(const TetMesh& mesh, TetEdge e) {
  const TetVertices& v = mesh.vertices(e.tet());
  const auto& other = kOtherVertices[e.edge()];
  return {e.tet(), v[other[0]], v[other[1]]};
}

/// To the tet behind the face opposite `from`; false at the boundary.
inline bool step(const TetMesh& mesh, Turn& turn) {
  const HalfFace next = mesh.twin(HalfFace(turn.tet, mesh.local_index(turn.tet, turn.from)));
  if (next.is_outside()) return false;
  turn = {next.tet(), turn.to, mesh.vertices(next.tet())[next.face()]};
  return true;
}

/// The other way round.
inline bool step_back(const TetMesh& mesh, Turn& turn) {
  const HalfFace next = mesh.twin(HalfFace(turn.tet, mesh.local_index(turn.tet, turn.to)));
  if (next.is_outside()) return false;
  turn = {next.tet(), mesh.vertices(next.tet())[next.face()], turn.from};
  return true;
}

/// Calls visit(tet) for the tets around an edge, in no particular order.
template <class Visit>
void visit_around(const TetMesh& mesh, TetEdge e, const Visit& visit) {
  const Turn first = first_turn(mesh, e);
  Turn turn = first;
  do {
    visit(turn.tet);
    if (step(mesh, turn)) continue;
    turn = first;
    while (step_back(mesh, turn)) visit(turn.tet);
    return;
  } while (turn.tet != first.tet);
}

}  // namespace tetmend::ring_walk
