// SPDX-License-Identifier: MIT
// Shows drawings of figure/ on top of the picture.
#pragma once

#include <imgui.h>

#include "figure/drawing.h"

namespace tetmend::viewer::ui {

/// Its lengths are pixels of the window. Areas must be convex. Words have the font of the panels,
/// whose widths are not those of Helvetica: they keep their beginning, middle or end.
void paint(const figure::Drawing& drawing, ImDrawList& list);

}  // namespace tetmend::viewer::ui
