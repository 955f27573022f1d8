// SPDX-License-Identifier: MIT
// What walls allow.
//
//   The tet on a wall is the determined tet of one of its three sectors, or none of them. In that
//   case it leaves a gap in each sector.
//   A gap is filled by at least one tet; the one that ends at the next wall has an angle of at most
//   the gap there. So a gap below the range makes the tet on the next wall bad.
#include "schedule/limit/wall_probe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tetmend {

WallProbe::WallProbe(const TetMesh& mesh, HalfFace wall) : mesh_(mesh), wall_(wall) {
  const auto v = mesh.vertices(wall);
  for (unsigned i = 0; i < 3; ++i) {
    const Point& corner = mesh.point(v[i]);
    const Point to_next = mesh.point(v[(i + 1) % 3]) - corner;
    const Point to_previous = mesh.point(v[(i + 2) % 3]) - corner;
    corners_[i] = std::atan2(to_next.cross(to_previous).norm(), to_next.dot(to_previous));
    sectors_[i] = find_sector(mesh, wall, i);
  }
  for (unsigned i = 0; i < 3; ++i) determined_[i] = determined_tet(i);
}

double WallProbe::DeterminedTet::angle_at(VertexHandle a, VertexHandle b) const {
  const auto place = [&](VertexHandle v) {
    return static_cast<std::size_t>(std::find(vertices.begin(), vertices.end(), v) -
                                    vertices.begin());
  };
  return angles[kEdgeOf[place(a)][place(b)]];
}

bool WallProbe::DeterminedTet::is_within(AngleRange range) const {
  return std::all_of(angles.begin(), angles.end(),
                     [&](double angle) { return range.contains(angle, kAngleSlack); });
}

WallProbe::DeterminedTet WallProbe::determined_tet(unsigned i) const {
  DeterminedTet tet;
  const auto v = mesh_.vertices(wall_);
  tet.vertices = {v[0], v[2], v[1], sectors_[i].apex};
  if (sectors_[i].angle >= std::numbers::pi || tet.vertices[3] == v[i]) return tet;
  const auto& [a, b, c, d] = tet.vertices;
  tet.angles = dihedral_angles(mesh_.point(a), mesh_.point(b), mesh_.point(c), mesh_.point(d));
  for (double& angle : tet.angles) angle *= std::numbers::pi / 180;
  tet.valid = true;
  return tet;
}

bool WallProbe::leaves_gap(const DeterminedTet& tet, HalfFace wall, unsigned edge,
                           const Sector& sector, double least) const {
  if (tet.has(sector.apex)) return true;  // ends at the next wall here too
  const auto v = mesh_.vertices(wall);
  const double gap = sector.angle - tet.angle_at(v[(edge + 1) % 3], v[(edge + 2) % 3]);
  return gap >= least - kAngleSlack;
}

bool WallProbe::leaves_room(unsigned i, double least_gap, Scope scope) const {
  const DeterminedTet& tet = determined_[i];
  for (unsigned k = 0; k < 3; ++k) {
    if (k != i && !leaves_gap(tet, wall_, k, sectors_[k], scope[k] ? least_gap : 0)) return false;
  }
  const HalfFace other = sectors_[i].other;
  const auto v = mesh_.vertices(other);
  for (unsigned k = 0; k < 3; ++k) {
    if (v[k] == sectors_[i].apex) continue;
    const Sector beyond = find_sector(mesh_, other, k);
    if (!leaves_gap(tet, other, k, beyond, scope[kBeyond] ? least_gap : 0)) return false;
  }
  return true;
}

bool WallProbe::allows(AngleRange range, Scope scope) const {
  for (unsigned i = 0; i < 3; ++i) {
    const DeterminedTet& tet = determined_[i];
    if (tet.valid && tet.is_within(range) && leaves_room(i, range.low, scope)) return true;
  }
  std::array<AngleRange, 3> base;
  for (unsigned i = 0; i < 3; ++i) {
    const double gap = scope[i] ? range.low : 0;
    base[i] = {range.low, std::min(range.high, sectors_[i].angle - gap)};
  }
  return has_apex(corners_, base, range);
}

std::vector<HalfFace> WallProbe::walls(Scope scope) const {
  std::vector<HalfFace> walls = {wall_};
  for (unsigned i = 0; i < 3; ++i) {
    if (scope[i]) walls.push_back(sectors_[i].other);
    if (!scope[kBeyond] || !determined_[i].valid) continue;
    const auto v = mesh_.vertices(sectors_[i].other);
    for (unsigned k = 0; k < 3; ++k) {
      if (v[k] != sectors_[i].apex) {
        walls.push_back(find_sector(mesh_, sectors_[i].other, k).other);
      }
    }
  }
  std::sort(walls.begin(), walls.end());
  walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
  return walls;
}

bool WallProbe::may_share_bad_tet(unsigned i, AngleRange range) const {
  const DeterminedTet& tet = determined_[i];
  return tet.valid && !tet.is_within(range) && leaves_room(i, 0, {});
}

}  // namespace tetmend
