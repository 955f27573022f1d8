// SPDX-License-Identifier: MIT
#include "trace/vertex_tets.h"

#include <algorithm>

namespace tetmend {

void VertexTets::follow(const SlotMesh& mesh, const ChangeLog& log) {
  const ChangeLog::Changes changes = log.since(seen_);
  const auto content = [&](std::uint32_t slot) {
    return mesh.is_deleted(TetHandle(slot)) ? TetVertices() : mesh.vertices(TetHandle(slot));
  };
  if (changes.everything) {
    const auto slots = static_cast<std::uint32_t>(std::max(mesh.tet_slots(), known_.size()));
    for (std::uint32_t slot = 0; slot < slots; ++slot) set(slot, content(slot));
  }
  for (const TetHandle t : changes.tets) set(t.index(), content(t.index()));
  seen_ = log.mark();
}

std::vector<TetHandle> VertexTets::tets_of(VertexHandle v) const {
  std::vector<TetHandle> tets;
  if (v.index() >= first_.size()) return tets;
  for (std::uint32_t corner = first_[v.index()]; corner != kNone; corner = next_[corner]) {
    tets.emplace_back(corner / 4);
  }
  std::sort(tets.begin(), tets.end());
  return tets;
}

void VertexTets::set(std::uint32_t slot, const TetVertices& vertices) {
  if (slot >= known_.size()) {
    if (!vertices[0].is_valid()) return;
    known_.resize(slot + 1);
    next_.resize(4 * known_.size(), kNone);
  }
  TetVertices& known = known_[slot];
  if (known == vertices) return;
  for (std::uint32_t k = 0; known[0].is_valid() && k < 4; ++k) take_out(4 * slot + k, known[k]);
  for (std::uint32_t k = 0; vertices[0].is_valid() && k < 4; ++k) {
    const std::uint32_t v = vertices[k].index();
    if (v >= first_.size()) first_.resize(v + 1, kNone);
    next_[4 * slot + k] = first_[v];
    first_[v] = 4 * slot + k;
  }
  known = vertices;
}

void VertexTets::take_out(std::uint32_t corner, VertexHandle v) {
  std::uint32_t* link = &first_[v.index()];
  while (*link != corner) link = &next_[*link];
  *link = next_[corner];
}

}  // namespace tetmend
