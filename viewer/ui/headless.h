// SPDX-License-Identifier: MIT
// The viewer without a window.
#pragma once

#include <memory>

#include "viewer/commands.h"

namespace tetmend::viewer {

/// Draws into memory; the clipboard is a string. Needs no display.
std::unique_ptr<Host> make_headless_host();

}  // namespace tetmend::viewer
