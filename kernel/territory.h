// SPDX-License-Identifier: MIT
// The part of a mesh that one worker may touch while others work on the rest.
#pragma once

#include <cstdint>
#include <span>

#include <tetmend/api.h>

#include "kernel/handles.h"

namespace tetmend {

/// Number of a block of vertices.
using BlockId = std::uint16_t;

/// The tets whose vertices all belong to one block. A tet between blocks belongs to nobody and
/// stays as it is; only its neighbour across a face of one block changes, and only with that block.
/// So a walk from tet to tet meets a foreign vertex before it meets what others change.
class TETMEND_API Territory {
 public:
  /// The whole mesh.
  Territory() = default;
  /// `blocks` names the block of each vertex slot and must outlive the territory.
  Territory(std::span<BlockId> blocks, BlockId mine) : blocks_(blocks.data()), mine_(mine) {}

  bool is_whole() const { return blocks_ == nullptr; }
  bool holds(VertexHandle v) const { return blocks_ == nullptr || blocks_[v.index()] == mine_; }
  /// A new vertex joins the block of the worker that made it.
  void claim(VertexHandle v) const {
    if (blocks_ != nullptr) blocks_[v.index()] = mine_;
  }

 private:
  BlockId* blocks_ = nullptr;
  BlockId mine_ = 0;
};

}  // namespace tetmend
