// SPDX-License-Identifier: MIT
// Call trees for people and for other programs: text, Graphviz, trace viewers.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "trace/trace_file.h"

namespace tetmend {

/// "edge_removal(3 17) level 0": vertices by handle number.
std::string describe_call(const TraceFile& file, std::uint32_t call);

/// The call and all in it, one a line, indented: its number, operator, target, level, verdict,
/// worst qualities, edits, reason. Precondition: there is such a call.
std::string call_tree_text(const TraceFile& file, std::uint32_t call);

/// The same as a graph for `dot`: accepted calls green, those undone with a caller pale with a
/// dashed border, refused ones red.
std::string call_tree_dot(const TraceFile& file, std::uint32_t call);

/// The whole trace in the JSON format of trace viewers (Perfetto, chrome://tracing): passes,
/// visits and calls as nested slices. Handed to `write` piece by piece. Times in microseconds.
void write_slices(const TraceFile& file, const std::function<void(std::string_view)>& write);

}  // namespace tetmend
