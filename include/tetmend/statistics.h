// SPDX-License-Identifier: MIT
// The figures by which a mesh is judged, named as in the paper, and what was found on reading it.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <tetmend/goal.h>

namespace tetmend {

/// Statistics of a mesh ([chen, Table 1] and 6.2). Angles in degrees, shares in percent of the
/// 6 x tets dihedral angles; the angles of an inverted tet are those of its mirror image, an angle
/// at a degenerate face counts as 0. All 0 for a mesh without tets.
struct MeshStatistics {
  std::size_t tets = 0;                ///< of any sign
  std::size_t vertices = 0;            ///< also those of no tet
  std::size_t boundary_triangles = 0;  ///< faces of one tet
  std::size_t inverted = 0;            ///< tets of negative volume
  std::size_t flat = 0;                ///< tets whose volume is zero or too close to tell
  double volume = 0;  ///< sum of the signed volumes; infinite or 0 where that is beyond a double
  double scaled_volume = 0;  ///< the same as a multiple of 8^scale: within a double for any mesh
  int scale = 0;             ///< 0 for a mesh of ordinary size
  double theta_min = 0;      ///< smallest dihedral angle
  double theta_max = 0;      ///< largest
  Goal goal;                 ///< what lambda and the bad tets refer to
  double lambda = 0;         ///< share of angles <= 30 or >= 150, or whatever the goal is
  /// lambda_i: angles in [6 (i-1), 6 i) or (180 - 6 i, 180 - 6 (i-1)], or in fifths of what is
  /// outside another goal. Angles of exactly 30 and 150 count for lambda_5, so that the five add up
  /// to lambda.
  std::array<double, 5> lambda_bands{};
  double q_worst = 0;     ///< smallest minimum sine
  double q_mean = 0;      ///< mean minimum sine of all tets
  std::size_t n_bad = 0;  ///< tets that miss the goal, in single precision
  double q_aver = 0;      ///< mean minimum sine of the bad tets; 0 without bad tets
  /// Dihedral angles in bins of 5 degrees, [5 i, 5 (i+1)); the last contains 180.
  std::array<std::size_t, 36> histogram{};
};

/// The three indicators by which a schedule gauges progress ([chen, 6.2]), of the tets that are not
/// protected: the others tell nothing about what is left to do.
struct QualityIndicators {
  double q_worst = 0;         ///< 1: the goal is just met
  std::size_t n_bad = 0;      ///< tets that miss the goal
  double q_aver = 0;          ///< mean quality of these and the needles; 0 without any
  std::size_t n_needles = 0;  ///< other tets of a quality below 1
};

/// Any quality measure over a whole mesh.
struct MeasureSummary {
  std::string_view name;  ///< of the measure
  double worst = 0;       ///< of any tet
  double mean = 0;        ///< of all tets
};

/// What building a mesh from a file's contents, or from arrays, found and did.
struct BuildReport {
  /// Most tets were negative: the order of two vertices was swapped in every tet.
  bool mirrored = false;
  /// Tets that only listed their vertices the other way round: corrected.
  std::size_t reordered_tets = 0;
  std::size_t inverted_tets = 0;  ///< tets of negative volume that were kept
  std::size_t flat_tets = 0;      ///< tets of zero volume (or too close to tell) that were kept
  /// Named triangles that are no face of any tet: kept for output, no constraint.
  std::size_t loose_triangles = 0;
  /// Named edges that are no edge of any tet: kept for output; their vertices are fixed.
  std::size_t loose_edges = 0;
  std::size_t unused_points = 0;      ///< points of no tet and no other element: kept
  std::size_t constrained_faces = 0;  ///< interior faces that must survive
  // Where constraints inside regions are ignored:
  std::size_t dropped_triangles = 0;  ///< no longer kept
  std::size_t dropped_edges = 0;      ///< no longer kept
  std::size_t dropped_vertices = 0;   ///< no longer required
};

}  // namespace tetmend
