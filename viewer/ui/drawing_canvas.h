// SPDX-License-Identifier: MIT
// Shows drawings: on top of the picture, and inside panels, where the mouse can ask them.
#pragma once

#include <span>

#include <imgui.h>

#include "explain/figures/linked_drawing.h"
#include "explain/outcome_look.h"
#include "figure/drawing.h"
#include "viewer/debugger/tets_drawing.h"
#include "viewer/document.h"

namespace tetmend::viewer::ui {

inline ImU32 to_imgui(const Colour& c) {
  return IM_COL32(c.red, c.green, c.blue, c.alpha);
}
/// What ImGui's style has for a part.
Colour colour_of(ImGuiCol part);
/// Text in the colour of a curve, lighter where the background is dark: so that it can be read.
void coloured_text(const Colour& colour, const std::string& text);

/// In pixels of the window.
void paint(const figure::Drawing& drawing, ImDrawList& list);

/// Takes a square of the size of the text for the mark of a call that ended so.
void show_mark(Outcome outcome);

/// The square of that side, in pixels, at the cursor of the panel.
Square square_at_cursor(float side);

/// Takes the square of that side at the cursor of the panel, in which the drawings lie, one after
/// the other. What the document points at is lit; what the mouse is on is pointed at.
void show_linked(const char* id, std::span<const LinkedDrawing> drawings, float side,
                 Document& document);
inline void show_linked(const char* id, const LinkedDrawing& drawing, float side,
                        Document& document) {
  show_linked(id, {&drawing, 1}, side, document);
}

}  // namespace tetmend::viewer::ui
