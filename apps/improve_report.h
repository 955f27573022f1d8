// SPDX-License-Identifier: MIT
// What `tetmend improve` tells about a run, as text and as JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "apps/regions.h"
#include "kernel/statistics.h"
#include "schedule/limit/surface_limit.h"
#include "schedule/run.h"
#include "schedule/schedule_parameter.h"

namespace tetmend::apps {

/// What is measured of a mesh before and after, to show that nothing was lost.
struct MeshCheck {
  MeshStatistics statistics;
  std::uint64_t surface_fingerprint = 0;
  std::size_t not_positive = 0;  ///< tets of negative or zero volume, in exact arithmetic
};

/// Seconds of each part of the work.
struct Timing {
  double reading = 0;
  double building = 0;   ///< adjacency, sorting along a space-filling curve
  double measuring = 0;  ///< statistics and checks, before and after
  double improving = 0;
  double writing = 0;

  double total() const { return reading + building + measuring + improving + writing; }
};

struct ImproveReport {
  std::vector<std::string> arguments;
  std::filesystem::path input;
  std::filesystem::path output;
  std::string schedule;
  ScheduleSettings settings;
  int threads = 1;
  bool interrupted = false;
  bool out_of_time = false;
  std::vector<std::string> notes;  ///< of the schedule
  BuildReport build;
  ProtectedPart protected_part;
  MeshCheck before;
  MeshCheck after;
  SurfaceLimit limit;  ///< of the mesh afterwards
  std::vector<PassRecord> passes;
  double touched_share = 0;  ///< tets created or with a moved vertex, as a share of all, 0 to 1
  Timing seconds;
  std::size_t peak_memory = 0;  ///< bytes of the process

  bool surface_unchanged() const;
  /// |after - before| / |before|; 0 when both are 0.
  double volume_change() const;
  /// Tets of the input for each second of improving.
  double tets_per_second() const;
};

/// All of it for people, at most 80 columns wide unless a file name is long.
std::string format_report(const ImproveReport& report);

/// All of it for programs.
nlohmann::json to_json(const ImproveReport& report);

}  // namespace tetmend::apps
