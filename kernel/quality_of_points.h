// SPDX-License-Identifier: MIT
// The quality of one tet, for loops that must not wait for a call.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "kernel/quality.h"

namespace tetmend {

/// Standard::quality(), to the bit.
inline double quality_of_points(const Standard& standard, const Point& p0, const Point& p1,
                                const Point& p2, const Point& p3) {
  if (standard.is_own()) return standard.quality(p0, p1, p2, p3);
  const Point e01 = p1 - p0;
  const Point e02 = p2 - p0;
  const Point e03 = p3 - p0;
  const Point e12 = p2 - p1;
  const Point e13 = p3 - p1;
  const Point e23 = p3 - p2;
  const Point n0 = e12.cross(e13);
  const Point n1 = e02.cross(e03);
  const Point n2 = e01.cross(e03);
  const Point n3 = e01.cross(e02);
  const double nn0 = n0.squaredNorm();
  const double nn1 = n1.squaredNorm();
  const double nn2 = n2.squaredNorm();
  const double nn3 = n3.squaredNorm();
  const double v6 = e01.dot(n1);
  const std::array<double, 6> l2 = {e01.squaredNorm(), e02.squaredNorm(), e03.squaredNorm(),
                                    e12.squaredNorm(), e13.squaredNorm(), e23.squaredNorm()};
  // Edge ij times the normals of the faces that do not contain it, that is opposite i and j.
  std::array<double, 6> r = {l2[0] * (nn0 * nn1), l2[1] * (nn0 * nn2), l2[2] * (nn0 * nn3),
                             l2[3] * (nn1 * nn2), l2[4] * (nn1 * nn3), l2[5] * (nn2 * nn3)};
  double weight = standard.acute2();
  if (!standard.is_even()) {
    weight = 1;
    // Normals 0 and 2 point outwards, 1 and 3 inwards, or all the other way round. The angle at an
    // edge lies between the faces that contain it: those opposite the two other corners.
    const std::array<double, 6> dots = {-n2.dot(n3), n1.dot(n3), -n1.dot(n2),
                                        -n0.dot(n3), n0.dot(n2), -n0.dot(n1)};
    for (std::size_t e = 0; e < 6; ++e)
      r[e] *= dots[e] > 0 ? standard.obtuse2() : standard.acute2();
  }
  const double smallest =
      std::min(std::min(std::min(r[0], r[1]), std::min(r[2], r[3])), std::min(r[4], r[5]));
  const double product = (nn0 * nn1) * (nn2 * nn3);
  if (!(product > 0)) return 0;
  const double sum = ((l2[0] + l2[1]) + (l2[2] + l2[3])) + (l2[4] + l2[5]);
  const double cube = sum * sum * sum;
  const double v2 = v6 * v6;
  const double by_length = (standard.flat2() * cube + standard.length() * v2) / (v2 * cube);
  return v6 * std::sqrt(std::min(weight * (smallest / product), by_length));
}

/// misses_goal() of any mesh that has qualities, vertices, points and a standard.
template <class Mesh>
bool misses_goal_of(const Mesh& mesh, TetHandle t) {
  if (mesh.quality(t) >= kBadThreshold) return false;
  if (mesh.standard().terms() != Standard::Terms::sine_and_length) return true;
  const auto& v = mesh.vertices(t);
  return static_cast<Quality>(mesh.standard().of_angles().quality(
             mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]))) <
         kBadThreshold;
}

}  // namespace tetmend
