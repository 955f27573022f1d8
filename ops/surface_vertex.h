// SPDX-License-Identifier: MIT
// A vertex of a surface that may change: where it may go, and its best place there. Shared by the
// operators that change the surface.
#pragma once

#include "kernel/surface_guard.h"
#include "ops/smoothing.h"

namespace tetmend {

/// May move, or vanish into a neighbour: it lies on a patch or a feature line that may change.
inline bool may_change(const TetMesh& mesh, VertexHandle v) {
  const SurfaceGuard* guard = mesh.surface_guard();
  if (guard == nullptr || mesh.is_frozen(v) || mesh.is_required(v)) return false;
  const SurfacePlace place = guard->place(v);
  return place == SurfacePlace::smooth || place == SurfacePlace::ridge;
}

/// Keeps a vertex, which may change, on its patch or line.
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

/// As climb(), also for a vertex of a surface that may change. Where the guard refuses the place,
/// half of the way is tried, and half of that.
void climb_at_surface(OperatorContext& context, Transaction& transaction, VertexHandle v,
                      const BallOptimiser::Limits& limits, BallState& state);

}  // namespace tetmend
