// SPDX-License-Identifier: MIT
// The default schedule: [chen, Alg. 6].
#pragma once

#include "schedule/passes.h"

namespace tetmend {

struct ShellSchedule {
  unsigned max_rounds = 30;   ///< of the main loop
  unsigned max_failed = 3;    ///< rounds in sequence without progress that end it
  LocalReconnection reconnection;
  SmoothingPass smoothing;
  SuppressionPass suppression;
  InsertionPass insertion;
};

/// Smooths, then repeats reconnection, suppression and insertion, each followed by smoothing, until rounds make no more progress.
/// Never changes the surface. Stops early when no bad tet is left or the run is cancelled.
void improve(Run& run, const ShellSchedule& schedule = {});

}  // namespace tetmend
