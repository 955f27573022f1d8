// SPDX-License-Identifier: MIT
// What the window knows again the next time: theme, panels, files that were opened.
#pragma once

#include "viewer/document.h"

namespace tetmend::viewer::ui {

/// From the user's folder for settings: XDG_CONFIG_HOME, ~/.config or APPDATA. A file that is not
/// there or makes no sense changes nothing.
void recall(Document& document);
/// Trouble is passed over: nothing of the user's work is in it.
void remember(const Document& document);

}  // namespace tetmend::viewer::ui
