// SPDX-License-Identifier: MIT
#include "kernel/workspace.h"

#include <cassert>
#include <utility>

namespace tetmend {

Workspace::Workspace(const TetMesh& mesh) {
  // From the back, so that low slots are used first.
  for (std::size_t i = mesh.tet_slots(); i-- > 0;) {
    const TetHandle t(static_cast<std::uint32_t>(i));
    if (mesh.is_deleted(t)) {
      free_.tets.push_back(t);
    } else if (!(mesh.quality(t) > 0)) {
      may_overlap_ = true;
    }
  }
  for (std::size_t i = mesh.vertex_slots(); i-- > 0;) {
    const VertexHandle v(static_cast<std::uint32_t>(i));
    if (mesh.is_deleted(v)) free_.vertices.push_back(v);
  }
}

Workspace Workspace::without_slots(const Workspace& first) {
  Workspace workspace;
  workspace.may_overlap_ = first.may_overlap_;
  return workspace;
}

void Workspace::enter(const Territory& territory, FreeSlots& slots, std::size_t more_tets) {
  constexpr std::size_t kMost = kAnyNumber / 4;  // differences keep their sign
  assert(depth_ == 0 && territory_.is_whole());
  territory_ = territory;
  most_more_tets_ = more_tets_ + std::min(more_tets, kMost);
  std::swap(free_, slots);
}

void Workspace::leave(FreeSlots& slots) {
  assert(depth_ == 0);
  territory_ = Territory();
  std::swap(free_, slots);
}

void Workspace::settle(TetMesh& mesh) {
  mesh.tet_count_ += std::exchange(more_tets_, 0);
  mesh.vertex_count_ += std::exchange(more_vertices_, 0);
}

void Workspace::provide(TetMesh& mesh, std::size_t tets, std::size_t vertices) {
  assert(depth_ == 0 && territory_.is_whole());
  if (free_.tets.size() < tets) {
    const auto first = static_cast<std::uint32_t>(mesh.tet_slots());
    free_.tets.reserve(tets);
    mesh.grow_tets(tets - free_.tets.size());
    for (std::uint32_t t = first; t < mesh.tet_slots(); ++t) free_.tets.push_back(TetHandle(t));
  }
  if (free_.vertices.size() < vertices) {
    const auto first = static_cast<std::uint32_t>(mesh.vertex_slots());
    free_.vertices.reserve(vertices);
    mesh.grow_vertices(vertices - free_.vertices.size());
    for (std::uint32_t v = first; v < mesh.vertex_slots(); ++v) {
      free_.vertices.push_back(VertexHandle(v));
    }
  }
}

}  // namespace tetmend
