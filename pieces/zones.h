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
  static constexpr std::size_t kLeast = 1000;
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
  std::uint32_t cluster = 0;  ///< balls of one touch each other, some in several zones
  std::uint32_t rank = 0;     ///< of its tet: 0 is the worst
};

/// Which zone a point lies in: that of the nearest ball around it, as measured by radii, or near the
/// middle of several that of the worst tet. Balls that touch are a cluster, and one zone unless that is cut. A cluster gives its number to the zone with
/// its worst tet.
class ZoneMap {
 public:
  ZoneMap() = default;
  /// A ball around each, the worst first.
  explicit ZoneMap(std::span<const WorstTet> worst);
  /// Of balls() of another.
  explicit ZoneMap(std::vector<Ball> balls);

  /// Adds 1 for each point to the entry of the ball that is nearest to it, if it is in one.
  void count(std::span<const Point> points, std::span<std::int64_t> by_ball) const;
  /// Cuts zones of more points: the worst ball stays with those nearest to it, and so on with what is
  /// left. What is left larger is a ball alone. Once.
  /// @param by_ball  points of each of balls()
  void cut(std::span<const std::int64_t> by_ball, std::int64_t most);

  std::size_t count() const { return count_; }
  /// What a zone gets of something that there is `all` of for all of them: clusters get the same,
  /// and of those that are cut the zone with the worst tet has half.
  std::size_t share(std::size_t all, std::size_t zone) const;
  /// Number of the zone; -1: none. Cost: log n, mostly.
  int find(const Point& p) const;
  const std::vector<Ball>& balls() const { return balls_; }

 private:
  struct Nearest {
    const Ball* ball = nullptr;
    double distance = 1;  ///< squared, in radii; 0: near the middle
  };
  void note_clusters();
  void arrange(std::size_t begin, std::size_t end);
  void search(std::size_t begin, std::size_t end, const Point& p, Nearest& nearest) const;

  std::size_t count_ = 0;
  std::vector<std::uint32_t> clusters_;      // by zone
  std::vector<Ball> balls_;                  // a tree: the middle of a range divides it
  std::vector<std::array<Point, 2>> boxes_;  // of the range that a ball is the middle of
};

}  // namespace tetmend::pieces
