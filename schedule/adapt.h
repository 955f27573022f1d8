// SPDX-License-Identifier: MIT
// The pass that makes edges as long as they are wanted.
#pragma once

#include "schedule/run.h"

namespace tetmend {

struct AdaptOptions {
  double floor = 0.35;  ///< no new tet is below that quality, or below the worst it replaces
  unsigned sweeps = 1;  ///< of each kind, at most; ends earlier when nothing is accepted
  bool split = true;
  bool contract = true;
};

/// Splits the edges that are longer than wanted, the longest first, and contracts those that are
/// shorter, the shortest first: see WantedLengths for the range. Lengths are relative to those wanted.
/// A surface that is fixed keeps its edges; where it may move, they are split and contracted, too.
/// @throws Error when the mesh has no wanted lengths
void adapt(Run& run, const AdaptOptions& options = {});

}  // namespace tetmend
