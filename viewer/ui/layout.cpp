// SPDX-License-Identifier: MIT
#include "viewer/ui/layout.h"

#include <algorithm>
#include <cmath>

namespace tetmend::viewer::ui {

namespace {

// At scale 1.
constexpr float kSideWidth = 290;
constexpr float kTraceSideWidth = 450;
constexpr float kStripHeight = 230;
// In smaller windows a trace has one column and a lower strip, so that the picture has half of it.
constexpr float kLeastForTwo = 1300;
constexpr float kOnlySideWidth = 390;
constexpr float kLowStripHeight = 170;
constexpr float kMenuHeight = 24;
constexpr float kStatusHeight = 26;
constexpr float kTeachingWidth = 0.38F;  // of the window
constexpr float kTeachingHeight = 250;
constexpr float kLeastTeachingWidth = 1100;
constexpr float kLeastTeachingHeight = 680;

void teach(Layout& layout, float width, float top, float bottom, float scale) {
  layout.is_teaching = true;
  layout.text = kTeachingText;
  const float side = std::round(kTeachingWidth * width);
  const float strip = kTeachingHeight * scale;
  layout.right = {width - side, top, side, bottom - top};
  layout.strip = {0, bottom - strip, width - side, strip};
  layout.canvas = {0, top, width - side, bottom - strip - top};
}

}  // namespace

Layout lay_out(const Document& document, float scale) {
  const auto width = static_cast<float>(document.window.width);
  const auto height = static_cast<float>(document.window.height);
  Layout layout;
  layout.canvas = {0, 0, width, height};
  if (!document.show_panels) return layout;
  const float top = std::round(kMenuHeight * scale);
  const float bottom = height - std::round(kStatusHeight * scale);
  if (bottom - top < 2 * top) return layout;  // the menu alone
  layout.status = {0, bottom, width, height - bottom};
  layout.canvas = {0, top, width, bottom - top};
  if (!document.has_mesh()) return layout;  // the start screen
  const bool has_trace = document.debugger() != nullptr;
  if (has_trace && document.teaching && width >= kLeastTeachingWidth * scale &&
      height >= kLeastTeachingHeight * scale) {
    teach(layout, width, top, bottom, scale);
    return layout;
  }
  const bool is_narrow = has_trace && width < kLeastForTwo * scale;
  const float wanted = !has_trace ? kSideWidth : is_narrow ? kOnlySideWidth : kTraceSideWidth;
  const float side = std::round(wanted * scale);
  const bool is_high = bottom - top >= 4 * top;
  const float columns = !is_high || 5 * side > 3 * width    ? 0
                        : is_narrow || 2 * width < 5 * side ? 1
                                                            : 2;
  layout.is_one_column = columns == 1;
  if (columns == 2) layout.left = {0, top, side, bottom - top};
  if (columns >= 1) layout.right = {width - side, top, side, bottom - top};
  layout.canvas = {layout.left.width, top, width - columns * side, bottom - top};
  const float strip = (is_narrow ? kLowStripHeight : kStripHeight) * scale;
  if (!has_trace || bottom - top < 2 * strip) return layout;
  layout.canvas.height -= strip;
  layout.strip = {layout.canvas.x, bottom - strip, layout.canvas.width, strip};
  return layout;
}

}  // namespace tetmend::viewer::ui
