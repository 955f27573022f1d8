// SPDX-License-Identifier: MIT
#include "ops/surface_vertex.h"

namespace tetmend {

void OnSurface::turn_along(const Point& p, std::span<Point> vectors) const {
  const Point direction = guard_.direction(v_, p);
  for (Point& vector : vectors) {
    const Point part = direction.dot(vector) * direction;
    vector = on_line_ ? part : Point(vector - part);
  }
}

void climb_at_surface(OperatorContext& context, Transaction& transaction, VertexHandle v,
                      const BallOptimiser::Limits& limits, BallState& state) {
  const TetMesh& mesh = context.mesh;
  if (!mesh.is_fixed(v)) return climb(context, transaction, v, limits, state);
  if (!may_change(mesh, v)) return;
  auto& [ball, link, point] = state;
  if (find_star(mesh, v, context.workspace, link) != StarKind::whole) return;
  load_ball(mesh, link, ball);
  const OnSurface restriction(*mesh.surface_guard(), v);
  ball.restrict_to(restriction);
  const Point old = mesh.point(v);
  point = old;
  const double start = ball.worst(point);
  if (start >= limits.enough || ball.optimise_from(point, start, limits) <= start) return;
  constexpr int kHalves = 2;
  for (int i = 0; i <= kHalves; ++i) {
    const VertexMove move = {v, point, link};
    if (transaction.move_at_surface({&move, 1}) != EditResult::constrained) return;
    point = restriction.nearest(0.5 * (old + point));
    if (!(ball.worst(point) > start)) return;
  }
}

}  // namespace tetmend
