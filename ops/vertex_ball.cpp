// SPDX-License-Identifier: MIT
#include "ops/vertex_ball.h"

#include <optional>

#include "kernel/workspace.h"

namespace tetmend {

namespace {

/// @param start quality of the worst tet of the ball, before
void move_along_surface(Transaction& transaction, VertexHandle v, const Point& old, double start,
                        const OnSurface& restriction, BallState& state) {
  auto& [ball, link, point] = state;
  constexpr int kHalves = 2;
  for (int i = 0; i <= kHalves; ++i) {
    const VertexMove move = {v, point, link};
    if (transaction.move_at_surface({&move, 1}) != EditResult::constrained) return;
    point = restriction.nearest(0.5 * (old + point));
    if (!(ball.worst(point) > start)) return;
  }
}

}  // namespace

void load_ball(const TetMesh& mesh, std::span<const HalfFace> link, BallOptimiser& ball) {
  ball.clear(mesh.standard());
  for (const HalfFace f : link) {
    const auto [a, b, c] = mesh.vertices(f);
    ball.add(mesh.point(a), mesh.point(b), mesh.point(c));
  }
}

void OnSurface::turn_along(const Point& p, std::span<Point> vectors) const {
  const Point direction = guard_.direction(v_, p);
  for (Point& vector : vectors) {
    const Point part = direction.dot(vector) * direction;
    vector = on_line_ ? part : Point(vector - part);
  }
}

void climb(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits, BallState& state, Where where) {
  const TetMesh& mesh = context.mesh;
  const bool on_surface = mesh.is_fixed(v);
  if (on_surface && (where == Where::inside || !may_change(mesh, v))) return;
  auto& [ball, link, point] = state;
  if (find_star(mesh, v, context.workspace, link) != StarKind::whole) return;
  load_ball(mesh, link, ball);
  std::optional<OnSurface> restriction;
  if (on_surface) ball.restrict_to(restriction.emplace(*mesh.surface_guard(), v));
  const Point old = mesh.point(v);
  point = old;
  const double start = ball.worst(point);
  if (start >= limits.enough || ball.optimise_from(point, start, limits) <= start) return;
  if (on_surface) {
    move_along_surface(transaction, v, old, start, *restriction, state);
  } else {
    transaction.move_vertex(v, point, link);
  }
}

}  // namespace tetmend
