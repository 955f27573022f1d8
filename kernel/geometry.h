// SPDX-License-Identifier: MIT
// Signed volumes and a certificate for their sign.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>
// The cross product alone: the rest of Eigen/Geometry takes a fifth of the time of
// <tetmend/kernel.h>.
#if EIGEN_VERSION_AT_LEAST(3, 4, 90)
#include <Eigen/Geometry>
#else
// clang-format off
#include <Eigen/src/Core/util/DisableStupidWarnings.h>
#include <Eigen/src/Geometry/OrthoMethods.h>
#include <Eigen/src/Core/util/ReenableStupidWarnings.h>
// clang-format on
#endif
#include <tetmend/api.h>

#include "kernel/mesh_data.h"

namespace tetmend {

/// Six times the signed volume of tet (a, b, c, d): (b-a) . ((c-a) x (d-a)). A valid tet has a
/// positive value.
inline double volume6(const Point& a, const Point& b, const Point& c, const Point& d) {
  // By numbers: expressions of Eigen cost every source that includes this a fiftieth of its time.
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
  const double x = ux * (vy * wz - vz * wy);
  const double y = uy * (vz * wx - vx * wz);
  const double z = uz * (vx * wy - vy * wx);
  return x + y + z;
}

/// x^(1/3) to the last bits, several times faster than std::cbrt. A third of the exponent and
/// Halley's method, which triples the digits in each step. Precondition: x > 0, normal.
inline double cube_root(double x) {
  double y = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) / 3 + 0x2A9F789300000000ull);
  for (int step = 0; step < 3; ++step) {
    const double cube = y * y * y;
    y *= (cube + 2 * x) / (2 * cube + x);
  }
  return y;
}

/// Six times the signed volume of a tet as computed, and more than its rounding error. Source:
/// static filter of [shewchuk_predicates], constant (7 + 56 eps) eps; the last term covers products
/// that underflow.
struct TETMEND_API FilteredVolume {
  double value;
  double error;
};

inline constexpr double kFilterShare = 7.7715611723761027e-16;
inline constexpr double kFilterUnderflow = 1e-300;

inline FilteredVolume filtered_volume6(const Point& a, const Point& b, const Point& c,
                                       const Point& d) {
  const Point u = b - a;
  const Point v = c - a;
  const Point w = d - a;
  const double v2w3 = v.y() * w.z();
  const double v3w2 = v.z() * w.y();
  const double v3w1 = v.z() * w.x();
  const double v1w3 = v.x() * w.z();
  const double v1w2 = v.x() * w.y();
  const double v2w1 = v.y() * w.x();
  const double det = u.x() * (v2w3 - v3w2) + u.y() * (v3w1 - v1w3) + u.z() * (v1w2 - v2w1);
  const double u1 = std::abs(u.x());
  const double u2 = std::abs(u.y());
  const double u3 = std::abs(u.z());
  const double permanent = u1 * (std::abs(v2w3) + std::abs(v3w2)) +
                           u2 * (std::abs(v3w1) + std::abs(v1w3)) +
                           u3 * (std::abs(v1w2) + std::abs(v2w1));
  return {det, kFilterShare * permanent + kFilterUnderflow * (1 + u1 + u2 + u3)};
}

/// True only if the exact volume of the tet with the given (double) coordinates is positive: the
/// computed value exceeds the rounding-error bound of the determinant. May say false for a positive
/// volume at rounding level, never true for a wrong one.
inline bool certified_positive(const Point& a, const Point& b, const Point& c, const Point& d) {
  const FilteredVolume volume = filtered_volume6(a, b, c, d);
  return volume.value > volume.error;
}

/// 1 or -1 only if that is the sign of the exact volume; 0 if it is too close to tell.
inline int certified_sign(const Point& a, const Point& b, const Point& c, const Point& d) {
  const FilteredVolume volume = filtered_volume6(a, b, c, d);
  return volume.value > volume.error ? 1 : volume.value < -volume.error ? -1 : 0;
}

}  // namespace tetmend
