// SPDX-License-Identifier: MIT
#include "viewer/ui/layout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

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
constexpr float kTeachingWidth = 0.38F;     // of the window
constexpr float kWideTeachingWidth = 0.6F;  // where the picture is not spoken of
constexpr float kTeachingHeight = 190;      // without a text
constexpr float kBarHeight = 58;            // buttons for fingers, and a margin
constexpr float kMostTextHeight = 0.45F;    // of the window
// Of a window with the whole of kTeachingText.
constexpr float kLeastTeachingWidth = 1100;
constexpr float kLeastTeachingHeight = 680;

/// What the lesson speaks of here; nothing between its steps, and without a lesson.
std::vector<Focus> focus_of(const Debugger& debugger) {
  std::vector<Focus> focus;
  if (debugger.lesson()) {
    for (const LessonStep& step : debugger.lesson()->steps) {
      if (step.at == debugger.position()) {
        focus.insert(focus.end(), step.focus.begin(), step.focus.end());
      }
    }
  }
  if (focus.empty()) return focus;
  if (debugger.call() == kNoCall) {  // there is none to be drawn
    std::erase(focus, Focus::ring);
    std::erase(focus, Focus::tables);
  }
  if (focus.empty()) focus = {Focus::picture};
  std::sort(focus.begin(), focus.end());
  focus.erase(std::unique(focus.begin(), focus.end()), focus.end());
  return focus;
}

/// Of the text and the question of a step; between steps there is what has happened.
float height_of_text(const Debugger& debugger, bool is_step, float width, float most, float scale) {
  if (!debugger.lesson() || !is_step) return kTeachingHeight * scale;
  constexpr float kLetter = 0.53F;  // of the size of the text, at most
  constexpr float kParagraph = 0.25F;
  constexpr float kMargins = 0.8F;
  const float size = 16 * kTeachingText * scale;
  const float letters = (width - 2 * size) / (kLetter * size);
  float lines = kMargins;
  const auto add = [&](const std::string& text) {
    lines += std::ceil(static_cast<float>(text.size()) / letters) + kParagraph;
  };
  const Lesson& lesson = *debugger.lesson();
  for (std::size_t n = 0; n < lesson.steps.size(); ++n) {  // all at one place are told
    if (lesson.steps[n].at != debugger.position()) continue;
    add(lesson.steps[n].text);
    const LessonQuestion* question = debugger.question_of(n);
    if (question != nullptr) add(question->text(question->is_right.has_value()));
  }
  return std::min(most, lines * size);
}

/// How much larger text is while teaching, for a window in which all has room. A lesson without its
/// text and its buttons is none: there it is never smaller than the usual one.
float teaching_text(const Document& document, float scale) {
  const float fit = std::min(static_cast<float>(document.window.width) / kLeastTeachingWidth,
                             static_cast<float>(document.window.height) / kLeastTeachingHeight);
  const float text = kTeachingText * std::min(1.0F, fit / scale);
  return document.debugger()->lesson() ? std::max(1.0F, text) : text;
}

/// At a step of a lesson the text stands below picture and column; elsewhere the column, for ring and
/// algorithm, is as high as the window. The buttons are at the bottom, however long the text is.
void lay_out_teaching(const Debugger& debugger, Layout& layout, float width, float top,
                      float bottom, float scale) {
  layout.is_teaching = true;
  layout.focus = focus_of(debugger);
  const bool is_step = !layout.focus.empty();
  if (!is_step) layout.focus = {Focus::picture, Focus::ring, Focus::algorithm};
  const bool has_picture = layout.focus.front() == Focus::picture;
  const bool has_column = layout.focus.back() != Focus::picture;
  const float share = !has_column ? 0 : has_picture ? kTeachingWidth : kWideTeachingWidth;
  const float side = std::round(share * width);
  const float bar = debugger.lesson() ? std::round(kBarHeight * scale) : 0;
  layout.bar = {0, bottom - bar, is_step ? width : width - side, bar};
  const float strip =
      std::round(height_of_text(debugger, is_step, width, kMostTextHeight * (bottom - top), scale));
  layout.strip = {0, bottom - bar - strip, layout.bar.width, strip};
  const float below = is_step ? strip + bar : 0;
  if (has_column) layout.right = {width - side, top, side, bottom - below - top};
  layout.canvas = {0, top, width - side, bottom - bar - strip - top};
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
  if (has_trace && document.teaching) {
    layout.text = teaching_text(document, scale);
    if (layout.text >= 1) {
      const float smaller = layout.text / kTeachingText;
      lay_out_teaching(*document.debugger(), layout, width, top, bottom, smaller * scale);
      return layout;
    }
    layout.text = 1;
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
