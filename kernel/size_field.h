// SPDX-License-Identifier: MIT
// How long edges are to be at each place: what the lengths of new edges are held to.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tetmend/api.h>

#include "kernel/mesh_data.h"

namespace tetmend {

class TetMesh;
class WantedLengths;

/// An edge, by the places of its ends.
using EdgePlaces = std::array<Point, 2>;

/// A length at every place, and which edges a change may leave there. Immutable.
class TETMEND_API SizeField {
 public:
  virtual ~SizeField() = default;

  /// At p, in the lengths that the mesh is worked with.
  virtual double length(const Point& p) const = 0;
  /// Whether a change may stay.
  /// @param before edges that it took away or moved; empty unless looks_back()
  /// @param now those that it made or moved
  virtual bool admits(std::span<const EdgePlaces> before,
                      std::span<const EdgePlaces> now) const = 0;
  /// It compares with what was there.
  virtual bool looks_back() const { return false; }
  /// The field as one of lengths that somebody wants; null: it is none.
  virtual const WantedLengths* wanted() const { return nullptr; }
};

/// How long edges were when a run began: at every place that of the nearest vertex, the mean length of
/// its edges.
class TETMEND_API UsualLengths final : public SizeField {
 public:
  /// Takes the lengths of the mesh as it is. Cost: n log n.
  explicit UsualLengths(const TetMesh& mesh);

  /// Nearest to p; of several the first in the mesh. Precondition: the mesh had a tet. Cost: log n,
  /// mostly.
  double length(const Point& p) const override;
  /// Each of them is at least half and at most twice as long as edges were at its midpoint.
  bool admits(std::span<const EdgePlaces> before, std::span<const EdgePlaces> now) const override;

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
