// SPDX-License-Identifier: MIT
// Where picture, columns of panels, strip and status line are.
#pragma once

#include <vector>

#include "viewer/document.h"

namespace tetmend::viewer::ui {

/// In pixels of the window.
struct Area {
  float x = 0, y = 0, width = 0, height = 0;
  bool is_empty() const { return width <= 0 || height <= 0; }
};

/// An empty area is not shown.
struct Layout {
  Area canvas;
  Area left, right;
  Area strip;  ///< under the picture
  Area bar;    ///< while a lesson is taught: its buttons, which stay where they are
  Area status;
  bool is_one_column =
      false;  ///< no room for two: all panels are in the right one, of a trace in tabs
  bool is_teaching = false;
  std::vector<Focus> focus;  ///< while teaching: what the right column shows
  float text = 1;            ///< size of text in panels, in units of the usual one
};

/// Larger text for a lecture hall.
inline constexpr float kTeachingText = 1.5F;

/// Without a mesh there are no columns. Of a window that is too small for all of them, columns and then
/// the strip are left out. From 1280 x 800 on, at scale 1, the picture has half of the window or more, or
/// there is room for a trace in two columns.
Layout lay_out(const Document& document, float scale);

}  // namespace tetmend::viewer::ui
