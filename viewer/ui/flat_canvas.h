// SPDX-License-Identifier: MIT
// Shows flat drawings inside a panel.
#pragma once

#include <imgui.h>

#include "viewer/debugger/flat_drawing.h"
#include "viewer/document.h"

namespace tetmend::viewer::ui {

inline ImU32 to_imgui(const Colour& c) {
  return IM_COL32(c.red, c.green, c.blue, c.alpha);
}

/// What the user points at, in all views.
inline constexpr Colour kPointedColour{255, 214, 10, 255};

/// A square of that side, in pixels, at the cursor of the panel. What the document points at is lit;
/// what the mouse is on is pointed at.
void show_flat(const char* id, const FlatDrawing& drawing, float side, Document& document);

/// One after the other in the same square.
void show_flat(const char* id, std::span<const FlatDrawing> drawings, float side,
               Document& document);

}  // namespace tetmend::viewer::ui
