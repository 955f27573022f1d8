// SPDX-License-Identifier: MIT
// A run whose trace gets its name later: when what else the run is to write has its own.
#pragma once

#include <memory>

#include <tetmend/improve.h>

#include "trace/recorder.h"

namespace tetmend::face {

/// As tetmend::improve(), but the trace is not finished.
/// @param trace what finish() gives its name; null if none was asked for. No event may follow.
Result improve(Mesh& mesh, const Options& options, std::unique_ptr<TraceRecorder>& trace);

}  // namespace tetmend::face
