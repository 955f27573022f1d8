// SPDX-License-Identifier: MIT
// The figures of a mesh that changes in few places, computed again and again.
#pragma once

#include <memory>

#include "kernel/statistics.h"

namespace tetmend {

/// Keeps what compute_statistics() computes of each chunk of slots, and measures those again in which
/// something changed.
class TETMEND_API StatisticsCache {
 public:
  StatisticsCache();
  ~StatisticsCache();
  StatisticsCache(const StatisticsCache&) = delete;
  StatisticsCache& operator=(const StatisticsCache&) = delete;

  /// Another mesh.
  void forget();
  /// The tet of this slot changed, a neighbour of it, or a point of it.
  void touch(TetHandle t);
  /// The same bits as of compute_statistics(mesh, goal).
  /// Cost: about half a millisecond for each chunk that was touched.
  const MeshStatistics& statistics(const TetMesh& mesh, const Goal& goal);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tetmend
