// SPDX-License-Identifier: MIT
// On which side of each triangle of a few points the others lie, as bits; whether two tets of them
// overlap.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/geometry.h"

namespace tetmend {

namespace detail {

/// Binomial coefficients of 0 to N over K.
template <unsigned K, unsigned N>
constexpr std::array<unsigned, N + 1> choose() {
  std::array<unsigned, N + 1> value{};
  for (unsigned n = K; n <= N; ++n) {
    value[n] = 1;
    for (unsigned k = 0; k < K; ++k) value[n] = value[n] * (n - k) / (k + 1);
  }
  return value;
}

}  // namespace detail

/// A set of points by their numbers.
using PointMask = std::uint32_t;

/// Signs are certified: a point that is too close to a plane to tell counts as on it.
class SideTable {
 public:
  static constexpr unsigned kMaxPoints = 32;

  struct Sides {
    PointMask above = 0;  ///< points d with volume6(a, b, c, d) > 0
    PointMask below = 0;
  };

  /// Place of a < b < c among all triangles, whatever the number of points; likewise for tets.
  static constexpr unsigned rank(unsigned a, unsigned b, unsigned c) {
    return kChoose3[c] + kChoose2[b] + a;
  }
  static constexpr unsigned rank(unsigned a, unsigned b, unsigned c, unsigned d) {
    return kChoose4[d] + rank(a, b, c);
  }

  void clear();
  /// Gives the point the next number. Precondition: there are fewer than kMaxPoints. Cost: cubic in
  /// their number, no memory from the heap unless there are more than ever before.
  void add(const Point& point);

  unsigned size() const { return size_; }
  const Point& point(unsigned n) const { return points_[n]; }
  const Sides& sides(unsigned triangle) const { return sides_[triangle]; }

  /// True only if the insides of the hulls of two sets of at most four points meet (of a triangle:
  /// what lies between its corners). Two such hulls can be parted, or there is a plane through
  /// three of the points that has them on different sides. Cost: 56 triangles at most.
  bool overlap(PointMask s, PointMask t) const;

 private:
  static constexpr auto kChoose2 = detail::choose<2, kMaxPoints>();
  static constexpr auto kChoose3 = detail::choose<3, kMaxPoints>();
  static constexpr auto kChoose4 = detail::choose<4, kMaxPoints>();

  unsigned size_ = 0;
  std::array<Point, kMaxPoints> points_;
  std::vector<Sides> sides_;  // by rank
};

}  // namespace tetmend
