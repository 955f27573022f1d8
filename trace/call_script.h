// SPDX-License-Identifier: MIT
// A call as a script of a schedule writes it. A script runs, so nothing of a trace gets into it unseen.
#pragma once

#include <string>
#include <string_view>

#include "trace/trace_file.h"

namespace tetmend {

/// True for "max_level = 5, order = \"longest\", {\"smoothing\"}, all_of{...}": names with plain
/// values, tables of these, and compositions. Nothing in it can be run.
bool is_plain_settings(std::string_view text);

/// `{"edge_removal", most_edges = 7}` or `sequence{...}`.
/// @throws Error when the operator's name or the settings are none that a recorder writes.
std::string script_of_call(const TraceFile& file, const Call& call);

}  // namespace tetmend
