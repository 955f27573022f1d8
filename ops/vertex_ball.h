// SPDX-License-Identifier: MIT
// A vertex and its ball: where it may go, and its best place there. Shared by the operators that
// move a vertex, or make a new one.
#pragma once

#include "ops/where.h"
#include "search/ball_optimiser.h"

namespace tetmend {

/// What operators on the ball of a vertex remember: its link, and its best place in there.
struct BallState {
  BallOptimiser ball;
  std::vector<HalfFace> link;
  Point point = Point::Zero();
};

/// Loads the ball around a vertex, given by its link, into the optimiser.
void load_ball(const TetMesh& mesh, std::span<const HalfFace> link, BallOptimiser& ball);

/// Keeps a vertex, which may change, on its patch or feature line.
class OnSurface final : public PlaceRestriction {
 public:
  OnSurface(const SurfaceGuard& guard, VertexHandle v)
      : guard_(guard), v_(v), on_line_(guard.place(v) == SurfacePlace::ridge) {}
  void turn_along(const Point& p, std::span<Point> vectors) const override;
  Point nearest(const Point& p) const override { return guard_.nearest(v_, p); }

 private:
  const SurfaceGuard& guard_;
  VertexHandle v_;
  bool on_line_;
};

/// Keeps a vertex that does not exist yet on a line, or in a plane.
class OnLineOrPlane final : public PlaceRestriction {
 public:
  /// @param direction of the line, or normal of the plane; of length 1
  OnLineOrPlane(const Point& origin, const Point& direction, bool on_line)
      : origin_(origin), direction_(direction), on_line_(on_line) {}
  void turn_along(const Point&, std::span<Point> vectors) const override {
    for (Point& vector : vectors) vector = part(vector);
  }
  Point nearest(const Point& p) const override { return origin_ + part(p - origin_); }

 private:
  Point part(const Point& vector) const {
    const Point along = direction_.dot(vector) * direction_;
    return on_line_ ? along : Point(vector - along);
  }

  Point origin_;
  Point direction_;
  bool on_line_;
};

/// Moves a vertex to where the worst tet of its ball is best, as part of a larger change. Leaves it
/// where it is if it may not move, its ball is good enough or partly in another worker's territory,
/// or nothing is gained. At the surface, vertices of a surface that may change move as well; where
/// the guard refuses the place, half of the way is tried, and half of that.
void climb(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits, BallState& state, Where where = Where::inside);

}  // namespace tetmend
