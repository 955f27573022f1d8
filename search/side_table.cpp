// SPDX-License-Identifier: MIT
#include "search/side_table.h"

#include <bit>
#include <cassert>

namespace tetmend {

void SideTable::clear() {
  size_ = 0;
  sides_.clear();
}

void SideTable::add(const Point& point) {
  assert(size_ < kMaxPoints);
  const unsigned d = size_++;
  points_[d] = point;
  sides_.resize(rank(0, 1, d + 1));
  const auto note = [&](Sides& sides, unsigned n, int sign) {
    sides.above |= static_cast<PointMask>(sign > 0) << n;
    sides.below |= static_cast<PointMask>(sign < 0) << n;
  };
  for (unsigned c = 2; c < d; ++c) {
    for (unsigned b = 1; b < c; ++b) {
      for (unsigned a = 0; a < b; ++a) {
        const int sign = certified_sign(points_[a], points_[b], points_[c], point);
        note(sides_[rank(a, b, c)], d, sign);
        note(sides_[rank(a, b, d)], c, -sign);
        note(sides_[rank(a, c, d)], b, sign);
        note(sides_[rank(b, c, d)], a, -sign);
      }
    }
  }
}

bool SideTable::overlap(PointMask s, PointMask t) const {
  std::array<unsigned, 8> corners{};
  unsigned count = 0;
  for (PointMask left = s | t; left != 0; left &= left - 1) {
    corners[count++] = static_cast<unsigned>(std::countr_zero(left));
  }
  for (unsigned k = 2; k < count; ++k) {
    for (unsigned j = 1; j < k; ++j) {
      for (unsigned i = 0; i < j; ++i) {
        const Sides& sides = sides_[rank(corners[i], corners[j], corners[k])];
        if (((s & sides.above) | (t & sides.below)) == 0) return false;
        if (((s & sides.below) | (t & sides.above)) == 0) return false;
      }
    }
  }
  return true;
}

}  // namespace tetmend
