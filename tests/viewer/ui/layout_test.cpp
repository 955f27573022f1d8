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
