// SPDX-License-Identifier: MIT
// The viewer without a window.
#pragma once

#include <memory>

#include "viewer/commands/commands.h"

namespace tetmend::viewer {

/// Draws into memory; the clipboard is a string. Needs no display. `scale` is that of the panels,
/// which are drawn when the document shows them. There can be one at a time.
std::unique_ptr<Host> make_headless_host(float scale);

}  // namespace tetmend::viewer
