// SPDX-License-Identifier: MIT
// What a run works towards.
#pragma once

#include <tetmend/language.h>

namespace tetmend {

/// No dihedral angle of a tet under `min_angle` or over `max_angle`, in degrees. A tet that misses
/// this is bad. What a fixed surface allows is mostly less than 45 and 135.
struct Goal {
  double min_angle = 30;   ///< above 0, at most 70
  double max_angle = 150;  ///< at least 71, below 180

  /// The same distance from 0 and from 180.
  static Goal symmetric(double min_angle) { return {min_angle, 180 - min_angle}; }
  /// Both angles are equal.
  friend bool operator==(const Goal&, const Goal&) = default;
};

}  // namespace tetmend
