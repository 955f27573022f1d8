// SPDX-License-Identifier: MIT
// --schedule, --set and --time-limit: which schedule runs, with which parameters, for how long.
#pragma once

#include <string>
#include <vector>

#include "schedule/schedule.h"

namespace CLI {
class App;
}

namespace tetmend::apps {

/// As the user wrote them.
struct ScheduleOptions {
  std::string schedule;
  std::vector<std::string> settings;  ///< NAME=VALUE
  double time_limit = 0;              ///< seconds; 0: none
};

/// A schedule that was found, and values that it accepts.
struct ChosenSchedule {
  Schedule schedule;
  ScheduleSettings settings;
};

void add_schedule_options(CLI::App& command, ScheduleOptions& options);

/// @throws UsageError for an unknown schedule or parameter, or a value out of range; Error for a
/// file that cannot be read or that has a mistake.
ChosenSchedule choose_schedule(const ScheduleOptions& options);

}  // namespace tetmend::apps
