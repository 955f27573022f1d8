// SPDX-License-Identifier: MIT
// The default schedule: [chen, Alg. 6].
#pragma once

#include "schedule/passes.h"

namespace tetmend {

struct ShellSchedule {
  unsigned max_rounds = 30;  ///< of the main loop
  unsigned max_failed =
      2;  ///< rounds in sequence without progress that end it, counted once the rounds are thorough
  LocalReconnection reconnection;
  SmoothingPass smoothing;
  SuppressionPass suppression;
  InsertionPass insertion;
  // Added when a round brought no progress and the rounds become thorough.
  LocalReconnection unfiltered_reconnection = {.calendar = "unfiltered reconnection",
                                               .edge_settings = {{"reflex_only", 0}},
                                               .threshold = 0.35f};
  InsertionPass relaxed_insertion = {
      .calendar = "relaxed insertion", .settings = {{"relax", 1}}, .share = 0.001};
};

/// Repeats reconnection, suppression and insertion, each followed by smoothing, until rounds make
/// no more progress; then goes on with unfiltered recursion and relaxed insertion until that makes
/// no more progress either. Never changes the surface. Stops early when no bad tet is left or the
/// run is cancelled.
void improve(Run& run, const ShellSchedule& schedule = {});

}  // namespace tetmend
