// SPDX-License-Identifier: MIT
// A part of a trace as data for a page: every step with all that the viewer shows of it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "trace/lesson.h"
#include "trace/replay.h"

namespace tetmend::explain {

/// Its members stay in the order in which they were put in.
using Json = nlohmann::ordered_json;

/// What a page is to have.
struct RecordingRange {
  std::uint64_t begin = 0, end = 0;  ///< positions, both included
  /// Calls with more calls around them are one step each, without a study.
  unsigned deepest = std::numeric_limits<unsigned>::max();
};

/// From where the call has begun to where it has ended. Precondition: there is such a call.
RecordingRange range_of_call(const TraceFile& file, std::uint32_t call);

/// Number of calls around the deepest call of a range.
unsigned depth_of(const TraceFile& file, const RecordingRange& range);

/// Number of calls that begin in a range.
std::size_t count_calls(const TraceFile& file, const RecordingRange& range);

/// Points and tets are listed once and named by their numbers; a step has the tets that come and go.
/// A point moved is another point of the same vertex. Coordinates are relative to the box of all.
/// assets/page/recording reads this. Leaves the replay where it was. Cost: a study of each call.
Json record(const TraceFile& file, Replay& replay, const RecordingRange& range);

}  // namespace tetmend::explain
