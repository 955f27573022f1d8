// SPDX-License-Identifier: MIT
// The figures by which a mesh is judged, named as in the paper.
#pragma once

#include <array>
#include <cstddef>

#include "kernel/quality.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// Statistics of a mesh ([chen, Table 1] and 6.2). Angles in degrees, shares in percent of the 6 x
/// tets dihedral angles. The angles of an inverted tet are those of its mirror image; an angle at a
/// degenerate face counts as 0. All 0 for a mesh without tets.
struct MeshStatistics {
  std::size_t tets = 0;
  std::size_t vertices = 0;  ///< live vertices, also those of no tet
  std::size_t boundary_triangles = 0;
  std::size_t inverted = 0;  ///< tets of negative volume
  std::size_t flat = 0;      ///< tets whose volume is zero or too close to tell
  double volume = 0;         ///< sum of the signed volumes
  double theta_min = 0;
  double theta_max = 0;
  double lambda = 0;  ///< share of angles <= 30 or >= 150
  /// lambda_i: angles in [6 (i-1), 6 i) or (180 - 6 i, 180 - 6 (i-1)]. Angles of exactly 30 and 150
  /// count for lambda_5, so that the five add up to lambda.
  std::array<double, 5> lambda_bands{};
  double q_worst = 0;     ///< smallest minimum sine
  double q_mean = 0;      ///< mean minimum sine of all tets
  std::size_t n_bad = 0;  ///< tets of minimum sine < 0.5, as the mesh stores it
  double q_aver = 0;      ///< mean minimum sine of the bad tets; 0 without bad tets
  /// Dihedral angles in bins of 5 degrees, [5 i, 5 (i+1)); the last contains 180.
  std::array<std::size_t, 36> histogram{};
};

/// An angle this close to the edge of a bin or a band (degrees) counts as lying on it. So it is not
/// left to rounding where the 60 degrees of a regular grid are counted.
inline constexpr double kAngleTolerance = 1e-9;

/// Computes everything from the points, not from cached qualities. The sums are compensated and run
/// in a fixed order, so the result depends on the mesh alone, not on the number of threads.
/// Cost: one pass over the tets, about 0.1 s for a million on one thread.
MeshStatistics compute_statistics(const TetMesh& mesh);

/// The three indicators by which the schedule gauges progress ([chen, 6.2]), from the cached
/// qualities. Frozen tets are left out: they tell nothing about what is left to do.
struct QualityIndicators {
  double q_worst = 0;
  std::size_t n_bad = 0;
  double q_aver = 0;  ///< mean quality of the bad tets; 0 without bad tets
};
/// Cost: one pass over the cached qualities.
QualityIndicators quality_indicators(const TetMesh& mesh);

/// Any quality measure over a whole mesh.
struct MeasureSummary {
  const QualityMeasure* measure = nullptr;
  double worst = 0;
  double mean = 0;
};

/// Precondition: `measure` outlives the result, as those of quality_measures() do.
/// Cost: one evaluation for each tet.
MeasureSummary summarize(const TetMesh& mesh, const QualityMeasure& measure);

}  // namespace tetmend
