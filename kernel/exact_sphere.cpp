// SPDX-License-Identifier: MIT
//   | a.x  a.y  a.z  |a|^2  1 |
//   | b.x  b.y  b.z  |b|^2  1 |      the opposite sign of this is what is asked for: each |.|^2
//   | c.x  c.y  c.z  |c|^2  1 |      times the volume of the other four points, with alternating
//   | d.x  d.y  d.z  |d|^2  1 |      signs
//   | p.x  p.y  p.z  |p|^2  1 |
#include "kernel/exact_sphere.h"

#include <array>
#include <cmath>

#include "kernel/exact_sum.h"

namespace tetmend {

namespace {

/// Of the rounding errors relative to the sum of all magnitudes: [shewchuk_predicates] proves less
/// than 17 units of 2^-53.
constexpr double kShare = 0x1p-48;
/// Errors of products that underflow stay far below kShare times kSmallest while no difference
/// exceeds kLargest: there are less than a hundred, each at most 2^-1074 kLargest^4.
constexpr double kLargest = 0x1p180;
constexpr double kSmallest = 0x1p-250;

/// A number, and what it would be if nothing were subtracted.
struct Tracked {
  double value;
  double magnitude;
};

/// p . (q x r)
Tracked triple(const Point& p, const Point& q, const Point& r) {
  Tracked sum = {0, 0};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double left = q[j] * r[k];
    const double right = q[k] * r[j];
    sum.value += p[i] * (left - right);
    sum.magnitude += std::abs(p[i]) * (std::abs(left) + std::abs(right));
  }
  return sum;
}

/// 0 where rounding could have changed the sign.
int side_by_doubles(const std::array<Point, 4>& from_p) {
  double value = 0;
  double magnitude = 0;
  double largest = 0;
  for (int i = 0; i < 4; ++i) {
    const Point& q = from_p[i];
    const Tracked volume = triple(from_p[(i + 1) % 4], from_p[(i + 2) % 4], from_p[(i + 3) % 4]);
    const double square = q.squaredNorm();
    value += (i % 2 == 0 ? square : -square) * volume.value;
    magnitude += square * volume.magnitude;
    largest = std::max(largest, q.cwiseAbs().maxCoeff());
  }
  if (!(largest < kLargest && magnitude > kSmallest)) return 0;
  const double error = kShare * magnitude;
  return value > error ? 1 : value < -error ? -1 : 0;
}

void add_terms(ExactSum<5>& sum, const Point& square, const Point& p, const Point& q,
               const Point& r, bool subtract) {
  for (const double s : square) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      sum.add({s, s, p[i], q[j], r[k]}, subtract);
      sum.add({s, s, p[i], q[k], r[j]}, !subtract);
    }
  }
}

int side_by_integers(const std::array<Point, 5>& points) {
  std::array<double, 15> coordinates;
  std::size_t n = 0;
  for (const Point& p : points) {
    for (const double x : p) coordinates[n++] = x;
  }
  ExactSum<5> sum(coordinates);
  for (std::size_t i = 0; i < 5; ++i) {
    std::array<Point, 4> others;
    std::copy_n(points.begin(), i, others.begin());
    std::copy(points.begin() + i + 1, points.end(), others.begin() + i);
    // The volume of the others, as in exact_orientation.cpp.
    const auto& [a, b, c, d] = others;
    const bool minus = i % 2 == 0;
    add_terms(sum, points[i], b, c, d, minus);
    add_terms(sum, points[i], a, c, d, !minus);
    add_terms(sum, points[i], a, b, d, minus);
    add_terms(sum, points[i], a, b, c, !minus);
  }
  return sum.sign();
}

}  // namespace

int side_of_sphere(const Point& a, const Point& b, const Point& c, const Point& d, const Point& p) {
  const int side = side_by_doubles({a - p, b - p, c - p, d - p});
  return side != 0 ? side : side_by_integers({a, b, c, d, p});
}

}  // namespace tetmend
