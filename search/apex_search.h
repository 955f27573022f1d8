// SPDX-License-Identifier: MIT
// Whether a tet on a given triangle can have dihedral angles in a given range, wherever its apex
// is.
#pragma once

#include <array>

namespace tetmend {

/// Angles in radians, ends included.
struct AngleRange {
  double low = 0;
  double high = 0;

  bool contains(double angle, double slack) const {
    return angle >= low - slack && angle <= high + slack;
  }
};

/// By how much, in radians, an angle may miss a range before it counts as outside. It covers the
/// rounding of the angles, and that of qualities to single precision.
inline constexpr double kAngleSlack = 1e-7;

/// False only if no tet on the triangle has all its angles in the ranges, give or take kAngleSlack.
/// `base` has the ranges at the three edges of the triangle, `side` that at the other three. The
/// search for an apex is limited in depth, and an open question counts as true.
/// @param corners angles of the triangle; base[i] belongs to the edge opposite corner i. All ranges
///   lie within (0, pi).
/// Cost: about 1 us where a tet in mid-range will do, up to a millisecond in close cases.
bool has_apex(const std::array<double, 3>& corners, const std::array<AngleRange, 3>& base,
              AngleRange side);

}  // namespace tetmend
