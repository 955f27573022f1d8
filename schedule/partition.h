// SPDX-License-Identifier: MIT
// Vertices in blocks along a space-filling curve: what workers share a mesh by.
#pragma once

#include <span>
#include <vector>

#include "kernel/hilbert.h"
#include "kernel/territory.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// Blocks of about the same number of vertices, each a piece of a Hilbert curve. Several partitions
/// of one mesh whose curves are shifted against each other have their borders at different places.
class Partition {
 public:
  /// `shift` 0, 1, 2, ... chooses the curve. Precondition: 1 <= blocks <= 65535. Cost: linear.
  Partition(const TetMesh& mesh, std::size_t blocks, unsigned shift);

  std::size_t block_count() const { return starts_.size(); }
  BlockId block(VertexHandle v) const { return block_[v.index()]; }
  /// For the territory of a worker.
  std::span<BlockId> blocks() { return block_; }

  /// Gives blocks to vertices that were added to the mesh.
  void include(const TetMesh& mesh, std::span<const VertexHandle> added);

 private:
  BlockId find_block(const Point& p) const;

  HilbertCurve curve_;
  std::vector<std::uint64_t> starts_;  // key at which each block begins
  std::vector<BlockId> block_;         // of each vertex slot
};

}  // namespace tetmend
