// SPDX-License-Identifier: MIT
// The tables M_q and M_k of the paper, filled as Algorithm 2 fills them ([chen, 4.2]).
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/quality.h"
#include "search/shell_locks.h"
#include "trace/slot_mesh.h"

namespace tetmend::explain {

/// Both tables have m rows and m columns, by places in the ring from 0: i * m + j. A pocket goes
/// from place i on to place j, beyond the last one if j < i.
struct PocketTables {
  std::size_t size = 0;  ///< m; 0: too many corners
  /// Quality of the best triangulation of a pocket; 0 if there is none, +infinity for a side.
  std::vector<Quality> quality;
  /// Place of the third corner of its triangle at the chord; `size` if there is none.
  std::vector<unsigned> apex;
  /// The worse of the two tets at a triangle i < k < j, in the order of loops over i, k, j; 0: not
  /// positive.
  std::vector<Quality> triangles;

  Quality q(std::size_t i, std::size_t j) const { return quality[i * size + j]; }
  unsigned k(std::size_t i, std::size_t j) const { return apex[i * size + j]; }
};

/// Of the shell or sandwich of a and b. As the search of the operators does, it leaves out pockets
/// that a lock forbids, and ranks triangulations by their three worst tets, where the paper takes
/// the worst alone: that decides between equals. Cost: cubic in the corners.
PocketTables fill_tables(const SlotMesh& mesh, VertexHandle a, VertexHandle b,
                         const std::vector<VertexHandle>& ring, const ShellLocks& locks);

}  // namespace tetmend::explain
