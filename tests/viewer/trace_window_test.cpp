// SPDX-License-Identifier: MIT
// Stepping through a trace in a window, with real keys and mouse events.
#include <doctest/doctest.h>

#include "tests/viewer/traces.h"
#include "tests/viewer/window.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("keys step into, over and out of the calls of a trace, and back") {
  if (!can_test_window()) return;
  const HandmadeTrace trace;
  Viewer viewer(trace.path(), "1300x850");
  type("mousemove 650 300");
  type("key Right Right Right");  // 3: in the recursion
  type("key Down");               // 6: over the transformation
  type("key Up");                 // 3
  type("key Right key Next");     // 4, and out: 6
  type("key Prior");              // 2: before the recursion
  type("key Right key Right key l key u");
  const auto state = viewer.quit();
  CHECK(state["trace"]["position"] == 6);
  CHECK(state["trace"]["bookmarks"] == 1);
  CHECK(state["trace"]["call"]["verdict"] == "no improvement");
}

TEST_CASE("the mouse goes to a place on the timeline") {
  if (!can_test_window()) return;
  const TracedBall trace;
  const auto end = static_cast<double>(TraceFile(trace.path()).event_count());
  Viewer viewer(trace.path(), "1300x850");
  // The strip lies between the side panels, above the status line.
  type("mousemove 640 640 sleep 0.5 mousemove 650 640 sleep 0.5 mousedown 1 sleep 0.5");
  type("mousemove 652 640 sleep 0.5 mouseup 1 sleep 0.5");
  const auto state = viewer.quit();
  const auto position = state["trace"]["position"].get<double>();
  CHECK(position / end == doctest::Approx(0.5).epsilon(0.05));
}
