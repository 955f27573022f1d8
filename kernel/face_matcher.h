// SPDX-License-Identifier: MIT
// Which faces of tets are the same, in linear time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace tetmend {

/// Finds the two sides of each face. Those that have no counterpart yet stand in lists, few in each: by
/// the sum of their vertices, so that neighbours are near each other in memory. Takes 12 bytes for a
/// vertex and for a side.
class FaceMatcher {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// @param points,sides numbers of vertices and of sides are below these
  FaceMatcher(std::size_t points, std::size_t sides)
      : heads_(3 * points, kNone), sides_(new Side[sides]) {}

  /// The side of the same face that was added before and has no counterpart yet, or kNone.
  /// @param side a number of its own
  std::uint32_t add(std::uint32_t side, std::array<std::uint32_t, 3> face) {
    if (face[0] > face[1]) std::swap(face[0], face[1]);
    if (face[1] > face[2]) std::swap(face[1], face[2]);
    if (face[0] > face[1]) std::swap(face[0], face[1]);
    std::uint32_t* link = &heads_[std::size_t{face[0]} + face[1] + face[2]];
    const std::uint32_t first = *link;
    for (std::uint32_t* next = link; *next != kNone; next = &sides_[*next].next) {
      const Side& other = sides_[*next];
      // With the sum these two vertices decide.
      if (other.low == face[0] && other.middle == face[1]) return std::exchange(*next, other.next);
    }
    sides_[side] = {face[0], face[1], first};
    *link = side;
    return kNone;
  }

  /// Calls act(face) with the vertices, ascending, of each face that has one side only.
  template <class Act>
  void for_single(const Act& act) const {
    for (std::size_t sum = 0; sum < heads_.size(); ++sum) {
      for (std::uint32_t side = heads_[sum]; side != kNone; side = sides_[side].next) {
        const auto [low, middle, next] = sides_[side];
        act(std::array<std::uint32_t, 3>{low, middle,
                                         static_cast<std::uint32_t>(sum - low - middle)});
      }
    }
  }

 private:
  struct Side {
    std::uint32_t low, middle;  // vertices
    std::uint32_t next;
  };
  std::vector<std::uint32_t> heads_;
  std::unique_ptr<Side[]> sides_;
};

}  // namespace tetmend
