// SPDX-License-Identifier: MIT
#include "viewer/ui/layout.h"

#include <algorithm>
#include <set>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/example_traces.h"
#include "tests/viewer/session.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

namespace {

/// What the picture has of the window.
double share_of(Document& document, int width, int height, float scale = 1) {
  document.window = {width, height};
  const ui::Area canvas = ui::lay_out(document, scale).canvas;
  return double{canvas.width} * canvas.height / (double{1} * width * height);
}

}  // namespace

TEST_CASE("the picture has at least half of a window of 1280 x 800, also of a trace") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  CHECK(share_of(s.document, 1280, 800) >= 0.5);
  CHECK(share_of(s.document, 2560, 1600, 2) >= 0.5);
  const test::HandmadeTrace trace;
  s.document.open(trace.path());
  CHECK(share_of(s.document, 1280, 800) >= 0.5);
  CHECK(share_of(s.document, 2560, 1600, 2) >= 0.5);
  CHECK(ui::lay_out(s.document, 2).is_one_column);
  s.document.window = {1920, 1080};
  CHECK_FALSE(ui::lay_out(s.document, 1).is_one_column);
}

TEST_CASE("a step of a lesson shows what it speaks of beside its picture, with buttons that stay") {
  for (const char* name : {"1-core", "2-two-shells", "3-refusals", "4-tables", "5-reconnection"}) {
    CAPTURE(name);
    TestSession s(test::one_tet());
    s.document.open(fmt::format(TETMEND_SOURCE_DIR "/assets/lessons/{}.json", name));
    const Lesson lesson = *s.document.debugger()->lesson();
    for (const auto& [width, height] : {std::pair{1280, 720}, std::pair{1920, 1080}}) {
      std::set<float> places;
      for (const LessonStep& step : lesson.steps) {
        s.run("seek", {step.at});
        s.document.window = {width, height};
        const ui::Layout layout = ui::lay_out(s.document, 1);
        REQUIRE(layout.is_teaching);
        const bool has_call = s.document.debugger()->call() != kNoCall;
        for (const Focus focus : step.focus) {
          if (!has_call && (focus == Focus::ring || focus == Focus::tables)) continue;
          CHECK(std::find(layout.focus.begin(), layout.focus.end(), focus) != layout.focus.end());
        }
        const bool is_picture_alone = layout.focus == std::vector{Focus::picture};
        CHECK(layout.right.is_empty() == is_picture_alone);
        CHECK(layout.canvas.height > 0.4 * height);
        CHECK(layout.bar.height >= 44);
        CHECK(layout.strip.y + layout.strip.height == layout.bar.y);
        places.insert(layout.bar.y);
      }
      CHECK(places.size() == 1);
    }
  }
}

TEST_CASE("a lesson has its text and its buttons in small windows and at large scales, too") {
  for (const char* name : {"1-core", "4-tables"}) {
    CAPTURE(name);
    TestSession s(test::one_tet());
    s.document.open(fmt::format(TETMEND_SOURCE_DIR "/assets/lessons/{}.json", name));
    const Lesson lesson = *s.document.debugger()->lesson();
    struct Window {
      int width, height;
      float scale;
    };
    for (const Window& window : {Window{1280, 720, 1.5F}, Window{1280, 720, 2}, Window{800, 600, 1},
                                 Window{800, 600, 1.5F}, Window{640, 480, 1}}) {
      CAPTURE(window.width);
      CAPTURE(window.scale);
      s.document.window = {window.width, window.height};
      for (const LessonStep& step : lesson.steps) {
        s.run("seek", {step.at});
        const ui::Layout layout = ui::lay_out(s.document, window.scale);
        REQUIRE(layout.is_teaching);
        CHECK(layout.text >= 1);
        CHECK(layout.text < ui::kTeachingText);
        constexpr float kFinger = 38;  // at scale 1
        CHECK(layout.bar.height >= kFinger * window.scale);
        CHECK(layout.strip.height > 2 * 16 * layout.text * window.scale);  // lines of text
        CHECK(layout.strip.y + layout.strip.height == layout.bar.y);
        CHECK(layout.bar.y + layout.bar.height == layout.status.y);
        CHECK(layout.canvas.height > 0.3 * window.height);
      }
    }
  }
}

TEST_CASE("without a lesson, teaching never makes text smaller than the usual one") {
  TestSession s(test::one_tet());
  const test::HandmadeTrace trace;
  s.document.open(trace.path());
  s.document.teaching = true;
  s.document.window = {1280, 720};
  const ui::Layout scaled = ui::lay_out(s.document, 1.5F);
  CHECK(scaled.is_teaching);
  CHECK(scaled.text >= 1);
  s.document.window = {640, 480};
  const ui::Layout usual = ui::lay_out(s.document, 1);
  CHECK_FALSE(usual.is_teaching);
  CHECK(usual.text == 1);
}
