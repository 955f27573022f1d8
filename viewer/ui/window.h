// SPDX-License-Identifier: MIT
// The viewer in a window.
#pragma once

#include <filesystem>
#include <functional>

#include "viewer/document.h"

namespace tetmend::viewer {

/// What is to be done when the first file is open. True: the mesh is to fill the space that the
/// panels leave.
using Then = std::function<bool(Document&)>;

/// Opens the file, if there is one, with a bar if that takes long, and shows the document until the
/// user closes the window. `scale` enlarges text and panels; 0 follows the screen.
/// @throws Error when no window can be opened, and as Document::open() and `then`.
void run_window(Document& document, float scale, const std::filesystem::path& file,
                const Then& then);

}  // namespace tetmend::viewer
