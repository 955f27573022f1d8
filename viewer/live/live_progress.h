// SPDX-License-Identifier: MIT
// How far a live run has come: plain data for panels and scripts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "kernel/geometry.h"
#include "kernel/statistics.h"
#include "trace/trace_sink.h"

namespace tetmend::viewer {

enum class LiveState : std::uint8_t {
  idle,      ///< nothing has run yet
  running,   ///< at work
  paused,    ///< held between two calls, or at a breakpoint inside of one
  stopping,  ///< about to end, as it was told to
  stopped,   ///< ended because it was told to
  finished,  ///< the schedule came to its end
  failed     ///< a mistake in the schedule, or trouble with memory or the trace
};
std::string_view to_string(LiveState state);

/// A pass that is over.
struct LivePass {
  std::string name;
  unsigned round = 0;
  std::size_t attempts = 0;  ///< by the schedule: calls by operators are not counted
  std::size_t accepted = 0;
  double seconds = 0;  ///< without pauses
  QualityIndicators after;
};

/// An attempt by the schedule; at a breakpoint, one by another attempt.
struct LiveCall {
  std::string operator_name;
  Point place = Point::Zero();  ///< middle of what it aimed at
  Quality before = 0;           ///< worst tet of those that it replaced
  Quality after = 0;            ///< worst of those that it made
  Verdict verdict = Verdict::accepted;
  std::vector<Point> target;  ///< corners of what it aimed at, as they were then
  std::size_t number = 0;     ///< of the attempt by the schedule, from 1
  unsigned level = 0;         ///< of recursion
  bool is_inside = false;     ///< made by another attempt
  bool is_under_way = false;  ///< not ended: there is no verdict yet
};

struct LiveProgress {
  LiveState state = LiveState::idle;
  std::string error;         ///< of a run that failed: "NAME:LINE: reason"
  std::string phase;         ///< pass at work
  unsigned round = 0;        ///< of the schedule
  double share = 0;          ///< of the pass that is done, 0 to 1
  double seconds = 0;        ///< without pauses
  std::size_t attempts = 0;  ///< in all, as LivePass counts them
  std::size_t accepted = 0;
  QualityIndicators before;  ///< of the mesh that the run began with
  std::vector<LivePass> passes;
  std::vector<std::string> notes;  ///< of the schedule
  std::optional<LiveCall> last_accepted;
  std::optional<LiveCall> last;  ///< accepted or not
  std::string breakpoint;        ///< at which the run was held; empty: for another reason
  std::string trace;             ///< file of the trace, once it is complete
  std::vector<std::string> held_parameters;  ///< changed while the run was held, in words
};

nlohmann::json to_json(const LiveProgress& progress);

}  // namespace tetmend::viewer
