// SPDX-License-Identifier: MIT
// The viewer in a window.
#pragma once

#include "viewer/document.h"

namespace tetmend::viewer {

/// Shows the document until the user closes the window. `scale` enlarges text and panels; 0 follows
/// the screen. `fit`: the mesh is to fill the space that the panels leave. @throws Error when no
/// window can be opened.
void run_window(Document& document, float scale, bool fit);

}  // namespace tetmend::viewer
