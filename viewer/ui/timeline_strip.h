// SPDX-License-Identifier: MIT
// The strip under the picture of a trace: passes, curves of quality, and the calls as icicles.
#pragma once

#include "viewer/commands/commands.h"

namespace tetmend::viewer::ui {

/// Fills the current window. Precondition: a trace is open.
void draw_timeline_strip(Session& session);

}  // namespace tetmend::viewer::ui
