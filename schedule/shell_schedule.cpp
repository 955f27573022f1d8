// SPDX-License-Identifier: MIT
//   repeat: reconnect, smooth, suppress points, smooth, insert points, smooth
//           after the first round that brings little: the thorough forms of reconnection and
//           insertion for the worst tets
//   until thorough rounds bring little, or 30 rounds are done
//   4 times: reconnect and insert at the very worst tets, smooth, suppress points, smooth,
//   reconnect, smooth
//
// DEVIATION: [chen, Alg. 6] smooths before the first reconnection, and stops after three rounds
// without progress. Both cost more than they bring (docs/deviations.md).
#include "schedule/shell_schedule.h"

#include <algorithm>

namespace tetmend {

namespace {

bool is_done(const Run& run, const QualityIndicators& now) {
  return now.n_bad == 0 || run.cancelled();
}

QualityIndicators run_round(Run& run, const ShellSchedule& schedule, bool thorough) {
  ++run.round;
  local_reconnection(run, schedule.reconnection);
  if (thorough) local_reconnection(run, schedule.unfiltered_reconnection);
  smooth(run, schedule.smoothing);
  suppress_points(run, schedule.suppression);
  smooth(run, schedule.smoothing);
  insert_points(run, thorough ? schedule.relaxed_insertion : schedule.insertion);
  smooth(run, schedule.smoothing);
  return run.records.back().after;
}

QualityIndicators run_last_round(Run& run, const ShellSchedule& schedule) {
  ++run.round;
  local_reconnection(run, schedule.last_reconnection);
  insert_points(run, schedule.last_insertion);
  smooth(run, schedule.smoothing);
  suppress_points(run, schedule.suppression);
  smooth(run, schedule.smoothing);
  local_reconnection(run, schedule.reconnection);
  smooth(run, schedule.smoothing);
  return run.records.back().after;
}

}  // namespace

void improve(Run& run, const ShellSchedule& schedule) {
  QualityIndicators before = quality_indicators(run.mesh());
  bool thorough = false;
  unsigned failed = 0;
  while (failed < schedule.max_failed && run.round < schedule.max_rounds && !is_done(run, before)) {
    const QualityIndicators now = run_round(run, schedule, thorough);
    if (thorough) {
      failed = is_progress(before, now) ? 0 : failed + 1;
    } else {
      thorough = static_cast<double>(now.n_bad) >
                 (1 - schedule.least_progress) * static_cast<double>(before.n_bad);
    }
    before = now;
  }
  for (unsigned n = 0; n < schedule.last_rounds && run.round < schedule.max_rounds; ++n) {
    if (is_done(run, before)) return;
    const std::size_t first = run.records.size();
    before = run_last_round(run, schedule);
    if (std::none_of(run.records.begin() + static_cast<std::ptrdiff_t>(first), run.records.end(),
                     [](const PassRecord& pass) { return pass.accepted() > 0; }))
      return;
  }
}

}  // namespace tetmend
