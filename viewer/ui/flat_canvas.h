// SPDX-License-Identifier: MIT
// Shows flat drawings inside a panel.
#pragma once

#include <imgui.h>

#include "viewer/debugger/flat_drawing.h"

namespace tetmend::viewer::ui {

inline ImU32 to_imgui(const Colour& c) {
  return IM_COL32(c.red, c.green, c.blue, c.alpha);
}

/// A square of that side, in pixels, at the cursor of the panel.
void show_flat(const char* id, const FlatDrawing& drawing, float side);

/// One after the other in the same square.
void show_flat(const char* id, std::span<const FlatDrawing> drawings, float side);

}  // namespace tetmend::viewer::ui
