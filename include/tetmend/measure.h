// SPDX-License-Identifier: MIT
// The figures of a mesh, and what its surface allows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/curved.h>
#include <tetmend/goal.h>
#include <tetmend/limit.h>
#include <tetmend/mesh.h>
#include <tetmend/rulers.h>
#include <tetmend/statistics.h>

namespace tetmend {

/// What measure() is to find out besides the statistics.
struct MeasureOptions {
  std::vector<std::string> measure = {};  ///< names of further measures, see measures()
  Goal goal = {};                         ///< a tet that misses it is bad
  bool rulers = true;                     ///< give Measurement::rulers
  bool limit = false;     ///< prove what the surface allows; seconds for a large mesh
  bool bad_tets = false;  ///< give Measurement::bad_tets; takes as long as `limit`
  int threads = 1;        ///< 1 to 1024; the result is the same for every number
};

/// A tet that misses the goal.
struct BadTet {
  std::size_t tet = 0;      ///< number, from 0
  std::int64_t number = 1;  ///< what the file calls it; from 1 where files do not number tets
  std::int32_t label = 0;   ///< of its region
  std::array<double, 3> centre{};           ///< its centroid
  double theta_min = 0;                     ///< degrees, its smallest dihedral angle
  double theta_max = 0;                     ///< degrees, its largest
  double quality = 0;                       ///< minimum sine; below 0: inverted
  int free_vertices = 0;                    ///< that may move
  Hindrance hindrance = Hindrance::search;  ///< why it is still there
};

/// What measure() found.
struct Measurement {
  MeshStatistics statistics;               ///< counts, angles, bad tets
  std::optional<MeshRulers> rulers;        ///< the measures of other programs
  std::optional<CurvedStatistics> curved;  ///< of a mesh of second order
  BuildReport build;                       ///< what is peculiar about the mesh
  std::vector<MeasureSummary> measures;    ///< in the order asked for
  std::optional<SurfaceLimit> limit;       ///< if asked for
  std::vector<BadTet> bad_tets;            ///< the worst first
  std::vector<std::string> notes;          ///< where points touch without being joined
};

/// Measures a mesh, and finds out whether its topology is sound. Move it in where it is not needed
/// any more: otherwise it is copied.
/// @throws OptionError for an unknown measure, or a goal that is none; Error, with the place in the file or the number of
/// the tet, for a mesh without tets or of broken topology: a face has more than two tets, or two
/// tets lie on the same side of a face.
TETMEND_API Measurement measure(Mesh mesh, const MeasureOptions& options = {});

/// Finds what is wrong with the options. @throws OptionError
TETMEND_API void check(const MeasureOptions& options);

/// One quality measure of a tet.
struct Measure {
  std::string_view name;  ///< as on the command line: "min_sine"
  std::string_view help;  ///< formula and range, one line
};

/// All that MeasureOptions::measure can name.
TETMEND_API std::vector<Measure> measures();

}  // namespace tetmend
