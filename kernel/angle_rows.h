// SPDX-License-Identifier: MIT
// Dihedral angles of several tets at once, as numbers that can be compared, and what statistics
// need besides.
#pragma once

#include <array>
#include <cstddef>

#include "kernel/compensated_sum.h"
#include "kernel/tet_rows.h"

namespace tetmend {

/// The key of an angle: cos |cos|, within [-1, 1]. Falls as the angle grows, and needs no root.
double angle_key(double degrees);

/// The angles of a block of tets; those of an inverted tet are those of its mirror image, an angle
/// at a degenerate face is 0. Lanes that are left over hold angles of a tet of the block.
struct AngleRows {
  static constexpr std::size_t kGroups = PointRows<4>::kMost / kWideLanes;
  template <class T>
  using Column = std::array<T, kGroups>;

  std::array<Column<WideVector>, 6> keys;  ///< by edge, in the order of kEdgeVertices
  Column<WideVector> greatest;             ///< key: of the smallest angle
  Column<WideVector> smallest;             ///< key: of the largest angle
};

/// What many tets come to.
struct AngleTally {
  WideSum volume6;
  WideSum sine;      ///< minimum_sine()
  WideSum bad_sine;  ///< of bad tets
  WideVector worst_sine;
  WideVector bad = {};       ///< counts
  WideVector positive = {};  ///< certainly
  WideVector inverted = {};  ///< certainly
  AngleTally();
};

/// A tet is bad if a key is above the first or below the second, or if it is not positive.
struct KeyLimits {
  double greatest = 1;
  double smallest = -1;
};

/// Computes the angles of a block, and adds its tets to a tally.
void compute_angles(const PointRows<4>& rows, const KeyLimits& limits, AngleRows& angles,
                    AngleTally& tally);

/// The sum of the lanes.
std::size_t total_count(const WideVector& counts);

}  // namespace tetmend
