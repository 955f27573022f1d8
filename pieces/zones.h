// SPDX-License-Identifier: MIT
// Zones: balls around the worst tets of a whole mesh, which are worked on once more, away from the
// borders between pieces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"
#include "kernel/quality.h"

namespace tetmend::pieces {

/// A tet that a zone may be made for.
struct WorstTet {
  Quality quality = 0;
  Point centre = Point::Zero();
  double reach = 0;  ///< its longest edge
  friend bool operator<(const WorstTet& a, const WorstTet& b);
};

/// The worst tets below a limit, as many as can be had; but always some, if there are bad ones.
/// The order in which they come cannot show.
class WorstTets {
 public:
  static constexpr std::size_t kMost = 10'000;
  static constexpr std::size_t kLeast = 100;
  static constexpr Quality kLimit = 0.5F;  ///< worse ones are all taken

  void add(const WorstTet& tet);
  void add(const WorstTets& others);
  /// The worst first.
  std::vector<WorstTet> take() const;
  /// All that take() may choose from once others are added.
  std::vector<WorstTet> all() const;

 private:
  void shorten();

  std::vector<WorstTet> tets_;
};

struct Ball {
  Point centre = Point::Zero();
  double radius = 0;
  std::uint32_t zone = 0;
};

/// Which zone a point lies in. Balls that touch are of one zone.
class ZoneMap {
 public:
  ZoneMap() = default;
  /// @param most tets of one zone, as far as their lengths tell: milder candidates that would make a
  /// zone larger are left out.
  ZoneMap(std::span<const WorstTet> worst, std::size_t most);
  /// Of balls() of another.
  explicit ZoneMap(std::vector<Ball> balls);

  std::size_t count() const { return count_; }
  /// Number of the zone; -1: none. Cost: log n, mostly.
  int find(const Point& p) const;
  const std::vector<Ball>& balls() const { return balls_; }

 private:
  void arrange(std::size_t begin, std::size_t end);
  const Ball* search(std::size_t begin, std::size_t end, const Point& p) const;

  std::size_t count_ = 0;
  std::vector<Ball> balls_;                  // a tree: the middle of a range divides it
  std::vector<std::array<Point, 2>> boxes_;  // of the range that a ball is the middle of
};

}  // namespace tetmend::pieces
