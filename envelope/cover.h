// SPDX-License-Identifier: MIT
// The envelope test: does a triangle lie within a tolerance of a set of others, wholly?
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "envelope/element.h"

namespace tetmend {

/// A convex set that may certify a piece, and how near the piece must be.
struct CoverTarget {
  std::array<Point, 3> points;
  unsigned corners = 3;
  double tolerance = 0;
  Point normal = Point::Zero();  ///< of the triangle; of a segment its direction
  bool used = false;             ///< afterwards: it certified a piece
};

/// Proves nearness without samples. The distance to a convex set is a convex function. So where all
/// corners of a convex piece lie within the tolerance of one and the same triangle, the whole piece
/// does. A piece for which none is found is cut along the sides of the triangle nearest to its
/// middle, or a little beyond them, or halved where that cuts nothing. A working memory.
class CoverTest {
 public:
  static constexpr unsigned kMostPieces = 128;

  /// True: each point of the polygon (2 or 3 corners) lies within the tolerance of one of the
  /// targets, that is proven up to the rounding of cuts. False: it does not, or would take too many
  /// pieces. With `nearest`, takes the nearest target for each piece, not the first that will do.
  bool covers(const std::array<Point, 3>& points, unsigned corners, std::span<CoverTarget> targets,
              bool nearest = false);
  void set_most_pieces(unsigned most) { most_pieces_ = most; }
  /// After true: a proven bound of the distance.
  double bound() const { return bound_; }

 private:
  static constexpr unsigned kMostCorners = 12;
  struct Piece {
    Piece() = default;
    // Copies what is there, no more.
    Piece(const Piece& other) : corners(other.corners) {
      std::copy_n(other.points.begin(), corners, points.begin());
    }
    Piece& operator=(const Piece& other) {
      corners = other.corners;
      std::copy_n(other.points.begin(), corners, points.begin());
      return *this;
    }
    ~Piece() = default;

    std::array<Point, kMostCorners> points;
    unsigned corners = 0;
    Point middle() const;
  };

  bool certify(const Piece& piece, std::span<CoverTarget> targets, bool nearest);
  bool divide(const Piece& piece, std::span<const CoverTarget> targets);
  bool cut(const Piece& piece, const CoverTarget& target, double beyond);
  void halve(const Piece& piece);

  unsigned most_pieces_ = kMostPieces;
  std::vector<Piece> stack_;
  double bound_ = 0;
};

}  // namespace tetmend
