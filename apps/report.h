// SPDX-License-Identifier: MIT
// Mesh statistics as text and as JSON, for people and for scripts. Formats only; nothing is printed
// here.
#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>
#include <tetmend/curved.h>
#include <tetmend/rulers.h>

#include "kernel/statistics.h"
#include "schedule/limit/surface_limit.h"

namespace tetmend {

// The texts below are plain ASCII, at most 80 columns wide, and end with a newline. A number that
// is not zero never prints as zero; a zero prints as 0.

/// Table of two meshes side by side: measure | before | after. Angles in degrees, shares of the
/// dihedral angles in percent. Rows for inverted and flat tets appear only when there are any.
std::string format_comparison(const MeshStatistics& before, const MeshStatistics& after);

/// Table of one mesh, with a row for the worst and the mean value of each further measure.
/// Precondition: no `measure` of `extra` is null.
std::string format_statistics(const MeshStatistics& statistics,
                              std::span<const MeasureSummary> extra = {});

/// Table of the measures of other programs: worst, 1 % and mean; with `after` those of two meshes
/// beside each other.
/// @param after may be null
std::string format_rulers(const MeshRulers& before, const MeshRulers* after);

/// What the tets of a mesh of second order are like, in two lines; with `after` two meshes.
/// @param after may be null
std::string format_curved(const CurvedStatistics& before, const CurvedStatistics* after);

/// Histogram of the dihedral angles in 18 bins of 10 degrees, counts and bars; with `after` the two
/// meshes stand side by side on one scale. The scale is logarithmic, so that a few bad angles among
/// millions show.
/// @param after may be null
std::string format_histogram(const MeshStatistics& before, const MeshStatistics* after);

/// How many of the bad tets are forced, what hinders the others, and the bounds that are known.
std::string format_limit(const SurfaceLimit& limit);

/// An object with the names of the fields of MeshStatistics; lambda_bands and histogram are arrays.
/// A number that is not finite becomes null, which JSON can express.
nlohmann::json to_json(const MeshStatistics& statistics);
/// An object with an object for each ruler by its name, and shortest_edge, inner_faces,
/// faces_above_70 and the numbers of kSolverRulers.
nlohmann::json to_json(const MeshRulers& rulers);
nlohmann::json to_json(const CurvedStatistics& curved);
/// The same for SurfaceLimit; `bad` is an object by hindrance, a bound that is not known is null.
nlohmann::json to_json(const SurfaceLimit& limit);

}  // namespace tetmend
