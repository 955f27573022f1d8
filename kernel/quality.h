// SPDX-License-Identifier: MIT
// Quality measures of a tet, chosen by name once. Larger is better, 0 is degenerate, negative is
// inverted.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "kernel/geometry.h"
#include "kernel/handles.h"

namespace tetmend {

/// Quality as the mesh stores it. Single precision is enough to rank tets; see kernel/judge.h for
/// comparisons.
using Quality = float;

/// What is measured, and from when on a tet is good.
struct Standard {
  std::string_view measure;  ///< a name of quality_measures()
  Quality good;
};

/// Minimum sine, no angle under 30 or over 150 degrees ([chen, 6.1]).
inline constexpr Standard kStandard = {"min_sine", 0.5f};

/// A tet of lower quality is bad.
inline constexpr Quality kBadThreshold = kStandard.good;

/// A measure is a pure function of the four points of a tet, in positive order for a valid tet.
struct QualityMeasure {
  std::string_view name;  ///< as in `--measure NAME`
  std::string_view help;  ///< one line: formula and value of the regular tet
  double (*evaluate)(const Point& a, const Point& b, const Point& c, const Point& d);
  double best;  ///< value of the regular tet
};

/// Minimum sine of the six dihedral angles, with the sign of the volume; the measure that tetmend
/// improves. 0 when a face is degenerate. Regular tet: 0.942809 (2 sqrt(2) / 3). One root and one
/// division. Source: [chen, 6.1]; sin(theta_ij) = V6 l_ij / (N_k N_l) with N the norms of the face
/// normals.
inline double minimum_sine(const Point& p0, const Point& p1, const Point& p2, const Point& p3) {
  const Point e01 = p1 - p0;
  const Point e02 = p2 - p0;
  const Point e03 = p3 - p0;
  const Point e12 = p2 - p1;
  const Point e13 = p3 - p1;
  const Point e23 = p3 - p2;
  const Point n1 = e02.cross(e03);
  const double n0 = e12.cross(e13).squaredNorm();
  const double n2 = e01.cross(e03).squaredNorm();
  const double n3 = e01.cross(e02).squaredNorm();
  const double nn1 = n1.squaredNorm();
  const double v6 = e01.dot(n1);
  // Edge ij times the normals of the faces that do not contain it, that is opposite i and j.
  const double a = std::min(e01.squaredNorm() * (n0 * nn1), e02.squaredNorm() * (n0 * n2));
  const double b = std::min(e03.squaredNorm() * (n0 * n3), e12.squaredNorm() * (nn1 * n2));
  const double c = std::min(e13.squaredNorm() * (nn1 * n3), e23.squaredNorm() * (n2 * n3));
  const double smallest = std::min(std::min(a, b), c);
  const double product = (n0 * nn1) * (n2 * n3);
  if (!(product > 0)) return 0;
  return v6 * std::sqrt(smallest / product);
}

/// The six dihedral angles in degrees, 0..180, at the edges in the order of kEdgeVertices. For an
/// inverted tet the angles of its mirror image. The angles at a degenerate face are 0.
std::array<double, 6> dihedral_angles(const Point& a, const Point& b, const Point& c,
                                      const Point& d);

/// Smallest dihedral angle in degrees, with the sign of the volume. Regular tet: 70.5288.
double minimum_dihedral_angle(const Point& a, const Point& b, const Point& c, const Point& d);

/// 6 sqrt(2) V / l_rms^3, l_rms the root mean square edge length. Regular tet: 1. Source:
/// [shewchuk_good].
double volume_length(const Point& a, const Point& b, const Point& c, const Point& d);

/// 3 r / R: inradius over circumradius, with the sign of the volume. Regular tet: 1.
double radius_ratio(const Point& a, const Point& b, const Point& c, const Point& d);

/// 12 (3 V)^(2/3) / sum of squared edge lengths, with the sign of the volume. Regular tet: 1.
double mean_ratio(const Point& a, const Point& b, const Point& c, const Point& d);

/// Minimum sine in which the sine of an obtuse angle counts 0.75 times: large angles weigh more.
/// Regular tet: 0.942809. Source: option of [klingner_shewchuk].
double warped_minimum_sine(const Point& a, const Point& b, const Point& c, const Point& d);

/// Sine of the largest dihedral angle, with the sign of the volume; 1 if none is obtuse.
double largest_angle_sine(const Point& a, const Point& b, const Point& c, const Point& d);

/// All measures; the first is the default.
std::span<const QualityMeasure> quality_measures();

/// @throws Error for an unknown name, with the valid ones.
const QualityMeasure& find_quality_measure(std::string_view name);

}  // namespace tetmend
