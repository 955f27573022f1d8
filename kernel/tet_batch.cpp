// SPDX-License-Identifier: MIT
// Qualities and filtered volumes of four tets side by side.
#include "kernel/tet_batch.h"

#include <cmath>

#include "kernel/quality_of_points.h"

namespace tetmend {

namespace {

/// Standard::quality() and filtered_volume6(), with every sum in the order in which these add up.
TETMEND_WIDE
void evaluate_groups(TetBatch::Group* groups, std::size_t count, const Standard& standard) {
  using B = TetBatch;
  const WideVector zero = {};
  const bool is_even = standard.is_even();
  const WideVector acute = zero + standard.acute2(), obtuse = zero + standard.obtuse2();
  const double flat2 = standard.flat2();
  const double length = standard.length();
  for (std::size_t n = 0; n < count; ++n) {
    WideVector* tet = groups[n].vectors();
    const WidePoint pa = {tet[B::ax], tet[B::ay], tet[B::az]};
    const WidePoint pb = {tet[B::bx], tet[B::by], tet[B::bz]};
    const WidePoint pc = {tet[B::cx], tet[B::cy], tet[B::cz]};
    const WidePoint pd = {tet[B::dx], tet[B::dy], tet[B::dz]};
    const WidePoint u = pb - pa, v = pc - pa, w = pd - pa;
    const WidePoint r = pc - pb, s = pd - pb, t = pd - pc;
    // Normals of the faces opposite the corners; those of a and c point outwards.
    const WidePoint a = cross(r, s), b = cross(v, w), c = cross(u, w), d = cross(u, v);
    const WideVector aa = dot(a, a), bb = dot(b, b), cc = dot(c, c), dd = dot(d, d);
    const WideVector uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    const WideVector rr = dot(r, r), ss = dot(s, s), tt = dot(t, t);
    WideVector ab = uu * (aa * bb), ac = vv * (aa * cc), ad = ww * (aa * dd);
    WideVector bc = rr * (bb * cc), bd = ss * (bb * dd), cd = tt * (cc * dd);
    if (!is_even) {  // the angle at ab lies between the faces opposite c and d
      ab *= dot(c, d) < zero ? obtuse : acute;
      ac *= dot(b, d) > zero ? obtuse : acute;
      ad *= dot(b, c) < zero ? obtuse : acute;
      bc *= dot(a, d) < zero ? obtuse : acute;
      bd *= dot(a, c) > zero ? obtuse : acute;
      cd *= dot(a, b) < zero ? obtuse : acute;
    }
    const WideVector least = smaller(smaller(smaller(ab, ac), smaller(ad, bc)), smaller(bd, cd));
    const WideVector product = (aa * bb) * (cc * dd);
    const WideVector v6 = dot(u, b);
    const WideVector square = v6 * v6;
    const WideVector sum = ((uu + vv) + (ww + rr)) + (ss + tt);
    const WideVector cube = sum * sum * sum;
    const WideVector by_sines = is_even ? acute * (least / product) : least / product;
    const WideVector by_length = (flat2 * cube + length * square) / (square * cube);
    const WideVector ratio = smaller(by_length, by_sines);
    WideVector root = {};
    for (std::size_t i = 0; i < kWideLanes; ++i) root[i] = std::sqrt(ratio[i]);
    tet[B::kQuality] = product > zero ? v6 * root : zero;

    const WidePoint size = {magnitude(u.x), magnitude(u.y), magnitude(u.z)};
    const WidePoint minors = {magnitude(v.y * w.z) + magnitude(v.z * w.y),
                              magnitude(v.z * w.x) + magnitude(v.x * w.z),
                              magnitude(v.x * w.y) + magnitude(v.y * w.x)};
    const WideVector permanent = dot(size, minors);
    const WideVector error =
        kFilterShare * permanent + kFilterUnderflow * (1.0 + size.x + size.y + size.z);
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

void TetBatch::evaluate_one_by_one(const Standard& standard) {
  for (std::size_t i = 0; i < size_; ++i) {
    const auto corner = [&](Row x) {
      return Point(value(x, i), value(static_cast<Row>(x + 1), i),
                   value(static_cast<Row>(x + 2), i));
    };
    groups_[i / kWideLanes].of[kQuality][i % kWideLanes] =
        quality_of_points(standard, corner(ax), corner(bx), corner(cx), corner(dx));
  }
}

void TetBatch::evaluate(const Standard& standard) {
  evaluate_groups(groups_.data(), (size_ + kWideLanes - 1) / kWideLanes, standard);
  if (standard.is_own()) evaluate_one_by_one(standard);
}

}  // namespace tetmend
