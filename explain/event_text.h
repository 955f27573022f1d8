// SPDX-License-Identifier: MIT
// What happened last, in words.
#pragma once

#include <cstdint>
#include <string>

#include "trace/trace_file.h"

namespace tetmend::explain {

/// "tet 12 13 14 15": whom a pass turned to.
std::string format_visit(const Visit& visit);

/// Of event number `position` - 1; at the beginning of the trace says so. Cost: see EventCursor.
std::string event_text(const TraceFile& file, std::uint64_t position);

}  // namespace tetmend::explain
