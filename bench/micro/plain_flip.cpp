// SPDX-License-Identifier: MIT
#include "bench/micro/plain_flip.h"

namespace tetmend::bench {

PlainMesh::PlainMesh(const TetMesh& mesh) {
  for (Index t = 0; t < mesh.tet_slots(); ++t) {
    const TetHandle tet(t);
    Cell cell{};
    for (unsigned i = 0; i < 4; ++i) {
      cell.vertices[i] = mesh.vertices(tet)[i].index();
      cell.neighbours[i] = mesh.neighbours(tet)[i].code();
    }
    cells_.push_back(cell);
    quality_.push_back(mesh.quality(tet));
    label_.push_back(mesh.label(tet));
    flags_.push_back(0);
  }
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    points_.push_back(mesh.point(VertexHandle(v)));
    vertex_tet_.push_back(mesh.tet_of(VertexHandle(v)).index());
  }
  free_.reserve(cells_.size());
}

PlainMesh::Index PlainMesh::beyond(Index t, Index v) const {
  const Cell& cell = cells_[t];
  unsigned i = 0;
  while (cell.vertices[i] != v) ++i;
  return cell.neighbours[i];
}

bool PlainMesh::measure(const std::array<Index, 4>& vertices, float& quality) const {
  const auto& [a, b, c, d] = vertices;
  if (!certified_positive(points_[a], points_[b], points_[c], points_[d])) return false;
  quality = static_cast<float>(minimum_sine(points_[a], points_[b], points_[c], points_[d]));
  return true;
}

void PlainMesh::glue(Index t, unsigned face, Index neighbour) {
  cells_[t].neighbours[face] = neighbour;
  if ((neighbour & kOutside) == 0) cells_[neighbour >> 2].neighbours[neighbour & 3] = 4 * t + face;
}

bool PlainMesh::flip_3_2(const Shell& shell) {
  const Index a = shell.a.index();
  const Index b = shell.b.index();
  const std::array<Index, 3> p = {shell.ring[0].index(), shell.ring[1].index(),
                                  shell.ring[2].index()};
  const std::array<Index, 4> upper = {a, p[0], p[1], p[2]};
  const std::array<Index, 4> lower = {p[0], p[1], p[2], b};
  float upper_quality = 0;
  float lower_quality = 0;
  if (!measure(upper, upper_quality) || !measure(lower, lower_quality)) return false;

  // Tet i of the shell is (a, b, p_i, p_i+1): its outer faces lie opposite p_i+2 in the new tets.
  std::array<Index, 3> above{};
  std::array<Index, 3> below{};
  for (unsigned i = 0; i < 3; ++i) {
    above[(i + 2) % 3] = beyond(shell.tets[i].index(), b);
    below[(i + 2) % 3] = beyond(shell.tets[i].index(), a);
  }

  const Index t = shell.tets[0].index();
  const Index u = shell.tets[1].index();
  const Index gone = shell.tets[2].index();
  cells_[t].vertices = upper;
  cells_[u].vertices = lower;
  glue(t, 0, 4 * u + 3);
  for (unsigned i = 0; i < 3; ++i) {
    glue(t, i + 1, above[i]);
    glue(u, i, below[i]);
  }
  quality_[t] = upper_quality;
  quality_[u] = lower_quality;
  label_[u] = label_[t];
  flags_[t] = flags_[u] = kTouched;
  vertex_tet_[a] = t;
  vertex_tet_[b] = u;
  for (const Index v : p) vertex_tet_[v] = t;
  cells_[gone].vertices[0] = kNone;
  free_.push_back(gone);
  return true;
}

}  // namespace tetmend::bench
