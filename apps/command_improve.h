// SPDX-License-Identifier: MIT
// A run from a mesh file to another, as `tetmend improve` and `tetmend adapt` make it.
#pragma once

#include "apps/commands.h"
#include "apps/improve_options.h"

namespace tetmend::apps {

/// Reads, works, writes and tells. Returns the exit status.
/// @throws UsageError, Error
int run_improve(ImproveOptions& options, Invocation& invocation);

}  // namespace tetmend::apps
