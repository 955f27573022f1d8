// SPDX-License-Identifier: MIT
// Walks from wall to wall around an edge.
#include "kernel/walls.h"

#include <cmath>
#include <numbers>

namespace tetmend {

namespace {

/// Angle by which face a b c must turn around a b to the left, as seen from a to b, to meet
/// face a b d; within (-pi, pi].
double turn_left(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point axis = b - a;
  const Point to_c = c - a;
  const Point to_d = d - a;
  return std::atan2(axis.dot(to_c.cross(to_d)) * axis.norm(),
                    axis.cross(to_c).dot(axis.cross(to_d)));
}

}  // namespace

Sector find_sector(const TetMesh& mesh, HalfFace wall, unsigned i) {
  const auto corners = mesh.vertices(wall);  // counterclockwise as seen from outside the sector
  const Point& a = mesh.point(corners[(i + 1) % 3]);
  const Point& b = mesh.point(corners[(i + 2) % 3]);
  TetHandle t = wall.tet();
  VertexHandle behind = corners[i];
  VertexHandle ahead = mesh.vertices(t)[wall.face()];
  double sum = 0;
  for (;;) {
    sum += std::abs(turn_left(a, b, mesh.point(behind), mesh.point(ahead)));
    const HalfFace face(t, mesh.local_index(t, behind));
    if (is_wall(mesh, face)) {
      const double turn = turn_left(b, a, mesh.point(corners[i]), mesh.point(ahead));
      // The sum tells a gap from its complement, and 0 from a full turn.
      constexpr double kTurn = 2 * std::numbers::pi;
      return {face, ahead, std::max(0.0, turn + kTurn * std::round((sum - turn) / kTurn))};
    }
    const HalfFace twin = mesh.twin(face);
    t = twin.tet();
    behind = ahead;
    ahead = mesh.vertices(t)[twin.face()];
  }
}

}  // namespace tetmend
