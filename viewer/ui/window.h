// SPDX-License-Identifier: MIT
// The viewer in a window.
#pragma once

#include "viewer/document.h"

namespace tetmend::viewer {

/// Shows the document until the user closes the window. `scale` enlarges text and panels; 0 follows
/// the screen. @throws Error when no window can be opened.
void run_window(Document& document, float scale);

}  // namespace tetmend::viewer
