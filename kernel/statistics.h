// SPDX-License-Identifier: MIT
// The figures by which a mesh is judged, computed.
#pragma once

#include <string>

#include <tetmend/api.h>
#include <tetmend/goal.h>
#include <tetmend/statistics.h>

#include "kernel/quality.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// An angle this close to the edge of a bin or a band (degrees) counts as lying on it. So it is not
/// left to rounding where the 60 degrees of a regular grid are counted.
inline constexpr double kAngleTolerance = 1e-9;

/// Computes everything from the points, not from cached qualities. The sums are compensated and run
/// in a fixed order, so the result depends on the mesh alone, not on the number of threads.
/// @param goal  a tet with an angle outside is bad; lambda counts angles at its ends and outside
/// Cost: one pass over the tets, about 0.03 s for a million on one thread.
TETMEND_API MeshStatistics compute_statistics(const TetMesh& mesh, const Goal& goal = {});

/// A volume, given as a multiple of 8^scale, as a decimal number of so many digits. That may be one
/// which no double holds.
TETMEND_API std::string volume_text(double scaled_volume, int scale, int digits);
TETMEND_API std::string volume_text(const MeshStatistics& statistics, int digits);

/// From the cached qualities of the tets that are not frozen.
/// Cost: one pass over the cached qualities.
TETMEND_API QualityIndicators quality_indicators(const TetMesh& mesh);

/// Precondition: the name of `measure` outlives the result, as those of quality_measures() do.
/// Cost: one evaluation for each tet.
TETMEND_API MeasureSummary summarize(const TetMesh& mesh, const QualityMeasure& measure);

}  // namespace tetmend
