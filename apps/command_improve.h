// SPDX-License-Identifier: MIT
// A run from a mesh file to another, as `tetmend improve` and `tetmend adapt` make it.
#pragma once

#include "apps/commands.h"
#include "apps/improve_options.h"

namespace tetmend::apps {

/// Reads, works, writes and tells. Returns the exit status.
/// @throws UsageError, Error
int run_improve(ImproveOptions& options, Invocation& invocation);

/// Of a run that wrote its mesh: kGoalMissed, which is told, where tets miss a goal that was asked for.
int goal_status(const ImproveOptions& options, const Result& result);

}  // namespace tetmend::apps
