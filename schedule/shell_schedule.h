// SPDX-License-Identifier: MIT
// The default schedule: [chen, Alg. 6].
#pragma once

#include "schedule/passes.h"

namespace tetmend {

struct ShellSchedule {
  unsigned max_rounds = 30;     ///< in all
  double least_progress = 0.1;  ///< a round that leaves more than 1 - this share of the bad tets is
                                ///< the last before the rounds become thorough
  unsigned max_failed = 1;      ///< thorough rounds in sequence without progress that end the loop
  unsigned last_rounds = 4;     ///< for the very worst tets
  LocalReconnection reconnection;
  SmoothingPass smoothing;
  SuppressionPass suppression;
  InsertionPass insertion;
  // Of the thorough rounds: dear forms for the worst tets.
  LocalReconnection unfiltered_reconnection = {.on = {.below = 0.25f, .at_least = 100},
                                               .edge_settings = {{"reflex_only", 0}}};
  InsertionPass relaxed_insertion = {.on = {.below = 0.25f, .at_least = 100},
                                     .settings = {{"relax", 1}}};
  // Of the last rounds: for few tets, a new mild bad tet is no reason to refuse.
  LocalReconnection last_reconnection = {.on = {.below = 0, .at_least = 32},
                                         .edge_settings = {{"reflex_only", 0}}};
  InsertionPass last_insertion = {.on = {.below = 0, .at_least = 32},
                                  .settings = {{"relax", 1}, {"desperate", 0.35}}};
};

/// Repeats reconnection, suppression and insertion, each followed by smoothing, until rounds bring
/// little; goes on with unfiltered recursion and relaxed insertion for the worst tets until that
/// brings little either; ends with a few rounds for the very worst. Never changes the surface.
/// Stops early when no bad tet is left or the run is cancelled.
void improve(Run& run, const ShellSchedule& schedule = {});

}  // namespace tetmend
