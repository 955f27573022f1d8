// SPDX-License-Identifier: MIT
// What `tetmend improve` tells about a run, as text and as JSON.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <tetmend/improve.h>

#include "apps/improve_options.h"
#include "face/portrait.h"
#include "pieces/out_of_core.h"

namespace tetmend::apps {

struct ImproveReport {
  std::vector<std::string> arguments;
  const ImproveOptions& options;
  std::vector<std::string> file_notes = {};  ///< what of the input is not in the output
  std::string regions = {};                  ///< of a dry run: how many, and what tells them apart
  Result result = {};
  face::Portrait portrait = {};                  ///< drawn if a report was asked for
  double reading = 0;                            ///< seconds
  double writing = 0;                            ///< seconds
  std::size_t peak_memory = 0;                   ///< bytes of the process, of many the largest
  std::vector<std::size_t> peaks_of_ranks = {};  ///< bytes; none where one process worked alone
  pieces::RunCosts costs = {};                   ///< likewise

  double total_seconds() const;
  /// Tets created or with a moved vertex, as a share of all, 0 to 1.
  double touched_share() const;
  /// Tets of the input for each second of improving.
  double tets_per_second() const;
};

/// What is printed: what most want to know, in about ten lines, or all if the options say so.
std::string format_outcome(const ImproveReport& report);

/// Of a run that tried nothing: what a run would keep, what it found, what the surface forces.
std::string format_prospect(const ImproveReport& report);

/// All of it for people, at most 80 columns wide unless a file name is long.
std::string format_report(const ImproveReport& report);

/// All of it for programs. With a portrait also histograms of the rulers and the worst tets left.
nlohmann::json to_json(const ImproveReport& report);

}  // namespace tetmend::apps
