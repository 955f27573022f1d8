// SPDX-License-Identifier: MIT
// Quality measures of a tet, chosen by name once. Larger is better, 0 is degenerate, negative is
// inverted.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>

#include "kernel/geometry.h"
#include "kernel/handles.h"

namespace tetmend {

/// Quality as the mesh stores it. Single precision is enough to rank tets; see `improves` for
/// comparisons.
using Quality = float;

/// A tet whose minimum sine is below this (an angle under 30 or over 150 degrees) is bad
/// ([chen, 6.1]).
inline constexpr Quality kBadThreshold = 0.5f;

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

/// Differences below this do not count as progress: they are within reach of rounding, and a run
/// would crawl.
inline constexpr Quality kQualityTolerance = 1e-6f;

/// True if the quality vector `now` is better than `before`: both ascending, compared
/// lexicographically, the shorter better when one continues the other ([chen, 6.1]). The first
/// entry that differs by more than kQualityTolerance decides, and no earlier entry may be lower at
/// all, so true also holds in the strict order.
bool improves(std::span<const Quality> now, std::span<const Quality> before);

/// How much a tet lacks to be good, (0.5 - q)^4, or 0: a sum of it weighs one very bad tet against
/// several mild ones.
inline double deficit(double quality) {
  const double lack = std::max(0.0, static_cast<double>(kBadThreshold) - quality);
  return (lack * lack) * (lack * lack);
}

/// True if the tets lack less in sum. By the order of quality vectors alone, insertions raise the
/// worst tet a little and leave more bad tets than they found.
inline bool lowers_deficit(std::span<const Quality> now, std::span<const Quality> before) {
  const auto total = [](std::span<const Quality> qualities) {
    double sum = 0;
    for (const Quality q : qualities) sum += deficit(q);
    return sum;
  };
  return total(now) < total(before);
}

/// The least gain that pays for one more bad tet. Tiny gains, one after the other, would fill the
/// neighbourhood with bad tets.
inline constexpr double kPriceOfBad = 0.001;

/// Where the worst tet is desperate, that is below this quality, more bad tets may come of a gain.
inline constexpr double kDesperate = 0.2;

/// True if the worst tet was below `desperate` and gained at least kPriceOfBad for each tet by
/// which the number of bad ones has grown. Both ascending.
bool pays_for_bad(std::span<const Quality> now, std::span<const Quality> before, double desperate);

/// True if a better worst tet is worth what it costs the others: they lack less in sum, or it pays
/// for them.
inline bool is_worth_it(std::span<const Quality> now, std::span<const Quality> before,
                        double desperate) {
  return pays_for_bad(now, before, desperate) || lowers_deficit(now, before);
}

/// Number of bad tets. Ascending.
inline std::ptrdiff_t count_bad(std::span<const Quality> qualities) {
  return std::lower_bound(qualities.begin(), qualities.end(), kBadThreshold) - qualities.begin();
}

}  // namespace tetmend
