// SPDX-License-Identifier: MIT
// How long edges were at each place when a run began.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

class TetMesh;

/// The local length at every place: that of the nearest vertex, the mean length of its edges.
/// Immutable.
class SizeField {
 public:
  /// Takes the lengths of the mesh as it is. Cost: n log n.
  explicit SizeField(const TetMesh& mesh);

  /// Nearest to p; of several the first in the mesh. Precondition: the mesh had a tet. Cost: log n,
  /// mostly.
  double length(const Point& p) const;
  /// An edge from a to b is at least half and at most twice as long as edges were at its midpoint.
  bool admits(const Point& a, const Point& b) const;

 private:
  struct Node {
    Point point;
    double length;
    std::uint32_t number;  // of the vertex
  };
  struct Nearest;

  void arrange(std::size_t begin, std::size_t end);
  void search(std::size_t begin, std::size_t end, Nearest& nearest) const;

  std::vector<Node> nodes_;  // a k-d tree: the middle of a range divides it
  std::vector<std::uint8_t> axes_;
};

/// By vertex slot the mean length of the edges there, an edge counted once for each of its tets; 0
/// for a deleted vertex. Cost: one pass over the tets.
std::vector<double> local_lengths(const TetMesh& mesh);

}  // namespace tetmend
