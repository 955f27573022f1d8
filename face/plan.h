// SPDX-License-Identifier: MIT
// The options of a run, looked through.
#pragma once

#include <tetmend/improve.h>

#include "face/growth.h"
#include "face/moving_surface.h"
#include "face/purpose.h"
#include "face/sizes.h"
#include "face/trace_plan.h"
#include "kernel/quality.h"
#include "ops/registry.h"
#include "schedule/schedule.h"

namespace tetmend::face {

/// @throws OptionError for angles that no tets have
void check_goal(const Goal& goal);

/// What the options stand for. Making it finds their mistakes.
struct Plan {
  Registry registry;
  Schedule schedule;
  TracePlan trace;
  const Purpose& purpose;
  std::vector<std::pair<std::string, std::string>> settings;  ///< of the schedule
  Growth growth;
  SurfaceTolerance surface;
  Sizes sizes;
  Standard standard;

  /// @throws OptionError as improve()
  /// @throws Error as improve()
  explicit Plan(const Options& options);
};

}  // namespace tetmend::face
