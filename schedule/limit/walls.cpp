// SPDX-License-Identifier: MIT
// Walks from wall to wall around an edge.
#include "schedule/limit/walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tetmend {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// Angle by which face a b c must turn around a b to the left, as seen from a to b, to meet
/// face a b d; within (-pi, pi].
double turn_left(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point axis = b - a;
  const Point to_c = c - a;
  const Point to_d = d - a;
  return std::atan2(axis.dot(to_c.cross(to_d)) * axis.norm(),
                    axis.cross(to_c).dot(axis.cross(to_d)));
}

/// Calls visit(tet, behind, ahead) for each tet of a sector, between the faces with these third
/// vertices. Gives the wall at its end.
template <class Visit>
HalfFace walk_to_next_wall(const TetMesh& mesh, HalfFace wall, unsigned i, const Visit& visit) {
  TetHandle t = wall.tet();
  VertexHandle behind = mesh.vertices(wall)[i];
  VertexHandle ahead = mesh.vertices(t)[wall.face()];
  for (;;) {
    visit(t, behind, ahead);
    const HalfFace face(t, mesh.local_index(t, behind));
    if (is_wall(mesh, face)) return face;
    const HalfFace twin = mesh.twin(face);
    t = twin.tet();
    behind = ahead;
    ahead = mesh.vertices(t)[twin.face()];
  }
}

/// Sum of the angles of the tets from the wall on, at its edge i.
double sum_of_angles(const TetMesh& mesh, HalfFace wall, unsigned i) {
  const auto corners = mesh.vertices(wall);
  const Point& a = mesh.point(corners[(i + 1) % 3]);
  const Point& b = mesh.point(corners[(i + 2) % 3]);
  double sum = 0;
  walk_to_next_wall(mesh, wall, i, [&](TetHandle, VertexHandle behind, VertexHandle ahead) {
    sum += std::abs(turn_left(a, b, mesh.point(behind), mesh.point(ahead)));
  });
  return sum;
}

}  // namespace

Sector find_sector(const TetMesh& mesh, HalfFace wall, unsigned i) {
  Sector sector;
  sector.other = walk_to_next_wall(
      mesh, wall, i, [&](TetHandle, VertexHandle, VertexHandle ahead) { sector.apex = ahead; });
  const auto corners = mesh.vertices(wall);  // counterclockwise as seen from outside the sector
  sector.angle = turn_left(mesh.point(corners[(i + 2) % 3]), mesh.point(corners[(i + 1) % 3]),
                           mesh.point(corners[i]), mesh.point(sector.apex));
  constexpr double kUnclear = 1e-3;
  if (std::abs(sector.angle) < kUnclear) {  // nothing or a full turn, give or take rounding
    const bool full = sum_of_angles(mesh, wall, i) > std::numbers::pi;
    sector.angle = full ? kTurn + std::min(sector.angle, 0.0) : std::max(sector.angle, 0.0);
  } else if (sector.angle < 0) {
    sector.angle += kTurn;
  }
  return sector;
}

TetHandle worst_in_sector(const TetMesh& mesh, HalfFace wall, unsigned i) {
  TetHandle worst = wall.tet();
  walk_to_next_wall(mesh, wall, i, [&](TetHandle t, VertexHandle, VertexHandle) {
    if (mesh.quality(t) < mesh.quality(worst)) worst = t;
  });
  return worst;
}

}  // namespace tetmend
