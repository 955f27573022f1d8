// SPDX-License-Identifier: MIT
//   smooth
//   repeat: reconnect, smooth, suppress points, smooth, insert points, smooth
//   until 3 rounds in sequence bring no progress, or 30 rounds are done
#include "schedule/shell_schedule.h"
#include <cstdlib>

namespace tetmend {

void improve(Run& run, const ShellSchedule& schedule) {
  smooth(run, schedule.smoothing);
  QualityIndicators before = quality_indicators(run.mesh());
  unsigned failed = 0;
  while (failed < schedule.max_failed && run.round < schedule.max_rounds && before.n_bad > 0 && !run.cancelled()) {
    ++run.round;
    { LocalReconnection r = schedule.reconnection; if (getenv("ROR") && run.round >= (unsigned)atoi(getenv("ROR"))) r.edge_settings = {{"reflex_only", 0}}; local_reconnection(run, r);}
    smooth(run, schedule.smoothing);
    suppress_points(run, schedule.suppression);
    smooth(run, schedule.smoothing);
    insert_points(run, schedule.insertion);
    smooth(run, schedule.smoothing);
    const QualityIndicators now = quality_indicators(run.mesh());
    failed = is_progress(before, now) ? 0 : failed + 1;
    before = now;
  }
}

}  // namespace tetmend
