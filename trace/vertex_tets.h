// SPDX-License-Identifier: MIT
// The tets of each vertex of a mesh without adjacency, kept up while the mesh changes.
#pragma once

#include <cstdint>
#include <vector>

#include "trace/change_log.h"
#include "trace/slot_mesh.h"

namespace tetmend {

/// Takes 32 bytes a tet and 4 a vertex.
class VertexTets {
 public:
  /// Cost: that of the changes; of everything, a pass over the slots.
  void follow(const SlotMesh& mesh, const ChangeLog& log);
  /// The tets of a vertex, by slot, in the mesh that was followed last.
  std::vector<TetHandle> tets_of(VertexHandle v) const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  void set(std::uint32_t slot, const TetVertices& vertices);
  void take_out(std::uint32_t corner, VertexHandle v);

  ChangeLog::Mark seen_;
  std::vector<TetVertices> known_;    // by slot
  std::vector<std::uint32_t> next_;   // by corner, 4 slot + k: the next corner at the same vertex
  std::vector<std::uint32_t> first_;  // by vertex
};

}  // namespace tetmend
