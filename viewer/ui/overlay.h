// SPDX-License-Identifier: MIT
// What is written over the picture: numbers of vertices, what is pointed at, and a legend.
#pragma once

#include "viewer/commands/commands.h"

namespace tetmend::viewer::ui {

/// False if there would be nothing to see.
bool has_overlay(Document& document);

/// Notes what of the picture the mouse is on. `mouse`: in pixels of the window.
void point_by_mouse(Document& document, float x, float y);

/// Behind all panels, in the font at hand. The legend is for pictures with panels.
void draw_overlay(Document& document);

}  // namespace tetmend::viewer::ui
