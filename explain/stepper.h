// SPDX-License-Identifier: MIT
// Where a step through a trace leads: into, over and out, forwards and backwards.
//
//   A position is a number of events that have happened. Passes, visits of tets and calls are
//   frames, nested in each other; a frame is open while its first event has happened and its last
//   has not.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "trace/trace_file.h"

namespace tetmend::explain {

enum class Step {
  into,  ///< one event
  over,  ///< one event; a frame that begins with it (backwards: ends with it) is one step
  out    ///< to the end (backwards: before the beginning) of the innermost open frame
};
enum class Direction { forward, back };

/// The position after a step; the same one at the ends of the trace. Cost: logarithmic.
std::uint64_t step_from(const TraceFile& file, std::uint64_t position, Step step,
                        Direction direction);

/// The innermost frame that is open; nothing outside of all.
std::optional<EventRange> open_frame(const TraceFile& file, std::uint64_t position);

/// Number of the visit of a tet that the last event belongs to, its first and last included.
std::optional<std::uint32_t> visit_at(const TraceFile& file, std::uint64_t position);

/// The call that the last event belongs to, and those around it, outermost first.
std::vector<std::uint32_t> call_stack(const TraceFile& file, std::uint64_t position);

}  // namespace tetmend::explain
