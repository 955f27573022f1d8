// SPDX-License-Identifier: MIT
// A run for a program: its trace gets its name later, when what else the run is to write has its own,
// and it can be drawn.
#pragma once

#include <memory>

#include <tetmend/improve.h>

#include "face/portrait.h"
#include "trace/recorder.h"

namespace tetmend::face {

/// As tetmend::improve(), but the trace is not finished.
/// @param trace what finish() gives its name; null if none was asked for. No event may follow.
/// @param portrait null, or empty; filled before improve() returns. For a million tets that takes
/// about 0.5 s on one thread.
Result improve(Mesh& mesh, const Options& options, std::unique_ptr<TraceRecorder>& trace,
               Portrait* portrait = nullptr);

}  // namespace tetmend::face
