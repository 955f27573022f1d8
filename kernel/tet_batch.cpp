// SPDX-License-Identifier: MIT
// Minimum sines and filtered volumes of four tets side by side.
#include "kernel/tet_batch.h"

#include <cmath>

namespace tetmend {

namespace {

/// minimum_sine() and filtered_volume6(), with every sum in the order in which these add up.
TETMEND_WIDE
void evaluate_groups(TetBatch::Group* groups, std::size_t count) {
  using B = TetBatch;
  const WideVector zero = {};
  for (std::size_t n = 0; n < count; ++n) {
    WideVector* tet = groups[n].vectors();
    // Edges u, v, w from a; r, s from b; t from c.
    const WideVector ux = tet[B::bx] - tet[B::ax], rx = tet[B::cx] - tet[B::bx];
    const WideVector uy = tet[B::by] - tet[B::ay], ry = tet[B::cy] - tet[B::by];
    const WideVector uz = tet[B::bz] - tet[B::az], rz = tet[B::cz] - tet[B::bz];
    const WideVector vx = tet[B::cx] - tet[B::ax], sx = tet[B::dx] - tet[B::bx];
    const WideVector vy = tet[B::cy] - tet[B::ay], sy = tet[B::dy] - tet[B::by];
    const WideVector vz = tet[B::cz] - tet[B::az], sz = tet[B::dz] - tet[B::bz];
    const WideVector wx = tet[B::dx] - tet[B::ax], tx = tet[B::dx] - tet[B::cx];
    const WideVector wy = tet[B::dy] - tet[B::ay], ty = tet[B::dy] - tet[B::cy];
    const WideVector wz = tet[B::dz] - tet[B::az], tz = tet[B::dz] - tet[B::cz];
    // Normals of the faces opposite b: v x w; a: r x s; c: u x w; d: u x v.
    const WideVector vywz = vy * wz, vzwy = vz * wy;
    const WideVector vzwx = vz * wx, vxwz = vx * wz;
    const WideVector vxwy = vx * wy, vywx = vy * wx;
    const WideVector bx = vywz - vzwy, by = vzwx - vxwz, bz = vxwy - vywx;
    const WideVector ax = ry * sz - rz * sy, ay = rz * sx - rx * sz, az = rx * sy - ry * sx;
    const WideVector cx = uy * wz - uz * wy, cy = uz * wx - ux * wz, cz = ux * wy - uy * wx;
    const WideVector dx = uy * vz - uz * vy, dy = uz * vx - ux * vz, dz = ux * vy - uy * vx;
    const WideVector na = ax * ax + ay * ay + az * az, nb = bx * bx + by * by + bz * bz;
    const WideVector nc = cx * cx + cy * cy + cz * cz, nd = dx * dx + dy * dy + dz * dz;
    const WideVector ab = (ux * ux + uy * uy + uz * uz) * (na * nb);
    const WideVector ac = (vx * vx + vy * vy + vz * vz) * (na * nc);
    const WideVector ad = (wx * wx + wy * wy + wz * wz) * (na * nd);
    const WideVector bc = (rx * rx + ry * ry + rz * rz) * (nb * nc);
    const WideVector bd = (sx * sx + sy * sy + sz * sz) * (nb * nd);
    const WideVector cd = (tx * tx + ty * ty + tz * tz) * (nc * nd);
    const WideVector least_at_a = ac < ab ? ac : ab;
    const WideVector least_between = bc < ad ? bc : ad;
    const WideVector least_elsewhere = cd < bd ? cd : bd;
    WideVector least = least_between < least_at_a ? least_between : least_at_a;
    least = least_elsewhere < least ? least_elsewhere : least;
    const WideVector product = (na * nb) * (nc * nd);
    const WideVector ratio = least / product;
    WideVector root = {};
    for (std::size_t i = 0; i < kWideLanes; ++i) root[i] = std::sqrt(ratio[i]);
    const WideVector v6 = ux * bx + uy * by + uz * bz;
    tet[B::kQuality] = product > zero ? v6 * root : zero;

    const WideVector u1 = ux < zero ? -ux : ux;
    const WideVector u2 = uy < zero ? -uy : uy;
    const WideVector u3 = uz < zero ? -uz : uz;
    const WideVector p1 = (vywz < zero ? -vywz : vywz) + (vzwy < zero ? -vzwy : vzwy);
    const WideVector p2 = (vzwx < zero ? -vzwx : vzwx) + (vxwz < zero ? -vxwz : vxwz);
    const WideVector p3 = (vxwy < zero ? -vxwy : vxwy) + (vywx < zero ? -vywx : vywx);
    const WideVector permanent = u1 * p1 + u2 * p2 + u3 * p3;
    const WideVector error = kFilterShare * permanent + kFilterUnderflow * (1.0 + u1 + u2 + u3);
    tet[B::kMargin] = v6 - error;
  }
}

}  // namespace

void TetBatch::add(const Point& a, const Point& b, const Point& c, const Point& d) {
  const std::size_t n = size_ / kWideLanes;
  const std::size_t k = size_ % kWideLanes;
  if (n == groups_.size()) groups_.emplace_back();
  auto& of = groups_[n].of;
  std::size_t row = ax;
  for (const Point* p : {&a, &b, &c, &d}) {
    for (int i = 0; i < 3; ++i, ++row) {
      if (k == 0) {
        of[row].fill((*p)[i]);
      } else {
        of[row][k] = (*p)[i];
      }
    }
  }
  ++size_;
}

void TetBatch::evaluate() {
  evaluate_groups(groups_.data(), (size_ + kWideLanes - 1) / kWideLanes);
}

}  // namespace tetmend
