// SPDX-License-Identifier: MIT
// The numbers that vertices get when pieces become one mesh again: how many of lower id there are.
#pragma once

#include <cstdint>
#include <vector>

#include "pieces/divided_mesh.h"

namespace tetmend::pieces {

/// A quarter of a byte for each vertex, on each rank.
class Numbering {
 public:
  /// All ranks: of the vertices of the stored pieces.
  explicit Numbering(const DividedMesh& mesh);

  std::uint64_t size() const { return count_; }
  /// @throws Error for a vertex that belongs to no piece
  std::uint64_t number(VertexId vertex) const;

 private:
  VertexId first_;
  std::vector<std::int64_t> is_there_;  // a bit for each id
  std::vector<std::uint64_t> before_;
  std::uint64_t count_ = 0;
};

}  // namespace tetmend::pieces
