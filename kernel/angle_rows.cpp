// SPDX-License-Identifier: MIT
// Keys of angles, minimum sines and filtered volumes of four tets side by side.
//
//   cosine = c / (n_k n_l), sine = V6 l / (n_k n_l), with n the norms of the face normals and c
//   their scalar product: key = c |c| / (c^2 + V6^2 l^2)
#include "kernel/angle_rows.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "kernel/geometry.h"

namespace tetmend {

namespace {

/// At an edge with that squared length. Not a number, after overflow, becomes an angle of 180
/// degrees.
TETMEND_WIDE_INLINE WideVector key_at(const WideVector& cosine, const WideVector& v6v6,
                                      const WideVector& l2) {
  const WideVector square = cosine * magnitude(cosine);
  const WideVector scale = magnitude(square) + v6v6 * l2;
  const WideVector one = WideVector{} + 1.0;
  const WideVector key = smaller(square / scale, one);
  return scale > 0.0 ? (key > -1.0 ? key : -one) : one;
}

}  // namespace

double angle_key(double degrees) {
  const double cosine = std::cos(degrees * std::numbers::pi / 180);
  return cosine * std::abs(cosine);
}

AngleTally::AngleTally() : worst_sine(WideVector{} + std::numeric_limits<double>::infinity()) {}

// Volumes and sines to the last bit as filtered_volume6() and minimum_sine() say.
TETMEND_WIDE void compute_angles(const PointRows<4>& rows, const KeyLimits& limits,
                                 AngleRows& angles, AngleTally& tally) {
  const WideVector zero = {};
  const WideVector one = zero + 1.0;
  for (std::size_t g = 0; g < rows.groups(); ++g) {
    const auto in_use = lanes_in_use(rows, g);
    const WidePoint p0 = wide_point(rows.group(g), 0), p1 = wide_point(rows.group(g), 1);
    const WidePoint p2 = wide_point(rows.group(g), 2), p3 = wide_point(rows.group(g), 3);
    const WidePoint u = p1 - p0, v = p2 - p0, w = p3 - p0, r = p2 - p1, s = p3 - p1, t = p3 - p2;
    // Normals of the faces opposite the corners; those of a and c point outwards.
    const WidePoint a = cross(r, s), b = cross(v, w), c = cross(u, w), d = cross(u, v);
    const WideVector aa = dot(a, a), bb = dot(b, b), cc = dot(c, c), dd = dot(d, d);
    const WideVector uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    const WideVector rr = dot(r, r), ss = dot(s, s), tt = dot(t, t);
    const WideVector v6 = dot(u, b), v6v6 = v6 * v6;
    // The angle at an edge lies between the faces opposite the other two corners.
    const std::array<WideVector, 6> key = {
        key_at(dot(c, d), v6v6, uu), key_at(-dot(b, d), v6v6, vv), key_at(dot(b, c), v6v6, ww),
        key_at(dot(a, d), v6v6, rr), key_at(-dot(a, c), v6v6, ss), key_at(dot(a, b), v6v6, tt)};
    for (std::size_t e = 0; e < 6; ++e) angles.keys[e][g] = key[e];
    const WideVector greatest =
        larger(larger(larger(key[0], key[1]), larger(key[2], key[3])), larger(key[4], key[5]));
    const WideVector smallest =
        smaller(smaller(smaller(key[0], key[1]), smaller(key[2], key[3])), smaller(key[4], key[5]));
    angles.greatest[g] = greatest;
    angles.smallest[g] = smallest;

    const WideVector least = smaller(
        smaller(smaller(uu * (aa * bb), vv * (aa * cc)), smaller(ww * (aa * dd), rr * (bb * cc))),
        smaller(ss * (bb * dd), tt * (cc * dd)));
    const WideVector product = (aa * bb) * (cc * dd);
    const WideVector ratio = least / product;
    WideVector root = {};
    for (std::size_t i = 0; i < kWideLanes; ++i) root[i] = std::sqrt(ratio[i]);
    const WideVector sine = product > zero ? v6 * root : zero;
    const WidePoint size = {magnitude(u.x), magnitude(u.y), magnitude(u.z)};
    const WidePoint minors = {magnitude(v.y * w.z) + magnitude(v.z * w.y),
                              magnitude(v.z * w.x) + magnitude(v.x * w.z),
                              magnitude(v.x * w.y) + magnitude(v.y * w.x)};
    const WideVector error =
        kFilterShare * dot(size, minors) + kFilterUnderflow * (1.0 + size.x + size.y + size.z);

    const auto is_bad =
        (greatest > limits.greatest) | (smallest < limits.smallest) | (sine <= zero);
    tally.worst_sine = smaller(sine, tally.worst_sine);
    add_to(tally.volume6, in_use ? v6 : zero);
    add_to(tally.sine, in_use ? sine : zero);
    add_to(tally.bad_sine, in_use & is_bad ? sine : zero);
    tally.bad += in_use & is_bad ? one : zero;
    tally.positive += (in_use & (v6 > error)) ? one : zero;
    tally.inverted += (in_use & (-v6 > error)) ? one : zero;
  }
}

std::size_t total_count(const WideVector& counts) {
  double sum = 0;
  for (std::size_t i = 0; i < kWideLanes; ++i) sum += counts[i];
  return static_cast<std::size_t>(sum);
}

}  // namespace tetmend
