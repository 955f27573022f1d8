// SPDX-License-Identifier: MIT
//   repeat: reconnect, smooth, suppress points, smooth, insert points, smooth
//           after the first round without progress: the thorough forms of reconnection and
//           insertion
//   until rounds in sequence bring no progress, or 30 rounds are done
//
// DEVIATION: [chen, Alg. 6] smooths before the first reconnection. On a Delaunay mesh that costs
// more than all other smoothing together, and the result is no better (docs/deviations.md).
#include "schedule/shell_schedule.h"

namespace tetmend {

void improve(Run& run, const ShellSchedule& schedule) {
  bool thorough = false;
  unsigned failed = 0;
  QualityIndicators before = quality_indicators(run.mesh());
  while (failed < schedule.max_failed && run.round < schedule.max_rounds && before.n_bad > 0 &&
         !run.cancelled()) {
    ++run.round;
    local_reconnection(run, schedule.reconnection);
    if (thorough) local_reconnection(run, schedule.unfiltered_reconnection);
    smooth(run, schedule.smoothing);
    suppress_points(run, schedule.suppression);
    smooth(run, schedule.smoothing);
    insert_points(run, thorough ? schedule.relaxed_insertion : schedule.insertion);
    smooth(run, schedule.smoothing);
    const QualityIndicators now = quality_indicators(run.mesh());
    if (is_progress(before, now)) {
      failed = 0;
    } else if (thorough) {
      ++failed;
    } else {
      thorough = true;
    }
    before = now;
  }
}

}  // namespace tetmend
