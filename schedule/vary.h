// SPDX-License-Identifier: MIT
// The pass that improves what surrounds the worst tets in many variants and keeps the best.
#pragma once

#include "schedule/schedule.h"

namespace tetmend {

struct VaryOptions {
  Selection on = {};
  Schedule schedule = Schedule::builtin("shell");
  ScheduleSettings settings = {};
  unsigned rings = 4;      ///< of vertices around a selected tet that its neighbourhood has
  unsigned variants = 16;  ///< of each neighbourhood
  unsigned first = 0;      ///< number of the first variant; those of other numbers are others
  /// Where at most half as many tets are bad, the worst may be worse: down to this share of its quality.
  double floor = 1;
};

/// Large neighbourhood search: cuts the neighbourhoods of selected tets out, the worst first, each tet
/// in one at most, and runs the schedule on copies of each: their vertices and tets are numbered anew
/// in each variant, most are shaken, and some aim at a higher goal. All copies are worked on side by side. Of each
/// neighbourhood the best copy replaces it if it has no more bad tets and a better quality vector. The border of a neighbourhood stays; so do
/// constraints, frozen tets and fixed vertices. The mesh is the same for any number of threads, and never worse,
/// but for a worst tet that pays for half of the bad ones. In the order of (number of bad tets, quality
/// vector) each neighbourhood only gets better.
///
/// A run that is stopped meanwhile leaves the neighbourhoods as they are.
/// Cost: that of the schedule, for each variant of some thousand tets.
/// @throws Error for a mistake in the schedule
void vary(Run& run, const VaryOptions& options);

}  // namespace tetmend
