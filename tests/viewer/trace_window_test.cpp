// SPDX-License-Identifier: MIT
// Stepping through a trace in a window, with real keys and mouse events.
#include <doctest/doctest.h>

#include "tests/viewer/traces.h"
#include "tests/viewer/window_session.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("keys step into, over and out of the calls of a trace, and back") {
  if (must_skip()) return;
  const HandmadeTrace trace;
  WindowSession window({"--size", "1300x850", trace.path().string()});
  type("mousemove 650 300");
  type("key Right Right Right");  // 3: in the recursion
  type("key Down");               // 6: over the transformation
  type("key Up");                 // 3
  type("key Right key Next");     // 4, and out: 6
  type("key Prior");              // 2: before the recursion
  type("key Right key Right key l key u");
  const auto state = window.quit();
  CHECK(state["trace"]["position"] == 6);
  CHECK(state["trace"]["bookmarks"] == 1);
  CHECK(state["trace"]["call"]["verdict"] == "no improvement");
}

TEST_CASE("the mouse goes to a place on the timeline, and keys run to breakpoints typed there") {
  if (must_skip()) return;
  const TracedBall trace;
  const viewer::Debugger debugger(trace.path());
  WindowSession window({"--size", "1300x850", trace.path().string()});
  // The strip lies between the side panels, above the status line.
  type("mousemove 650 680 sleep 0.3 mousedown 1 sleep 0.3 mousemove 652 680 sleep 0.3 mouseup 1");
  type("mousemove 650 300 sleep 0.3");
  const viewer::Image there = window.picture();
  type("key Home");
  const viewer::Image begin = window.picture();
  CHECK(viewer::count_red(there, 650, 340, 200) < viewer::count_red(begin, 650, 340, 200));
  type("mousemove 650 680 sleep 0.3 mousedown 1 sleep 0.3 mousemove 652 680 sleep 0.3 mouseup 1");
  const auto state = window.quit();
  const auto position = state["trace"]["position"].get<double>();
  CHECK(position / static_cast<double>(debugger.end()) == doctest::Approx(0.5).epsilon(0.05));
}
