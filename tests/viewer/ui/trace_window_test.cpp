// SPDX-License-Identifier: MIT
// Stepping through a trace in a window, with real keys and mouse events.
#include <doctest/doctest.h>

#include "tests/support/example_traces.h"
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
  CHECK(state["trace"]["bookmarks"] == nlohmann::json{4});
  CHECK(state["trace"]["call"]["verdict"] == "no improvement");
}

TEST_CASE("breakpoints are set, switched off and taken away with the mouse") {
  if (!can_test_window()) return;
  const HandmadeTrace trace;
  Viewer viewer(trace.path(), "1300x850");
  for (const char* place : {"refused", "deeper 0", "accepted"}) {
    click(200, 611);  // the place to run to
    type("key ctrl+a");
    type(fmt::format("type '{}'", place));
    click(213, 638);  // breakpoint
  }
  // Now there is a row for each, 27 pixels high.
  click(18, 665);   // "refused" is off
  click(414, 719);  // "accepted" is gone
  click(1071, 70);  // run
  const auto state = viewer.quit();
  CHECK(state["trace"]["breakpoints"] == nlohmann::json{"refused", "deeper 0"});
  CHECK(state["trace"]["position"] == 7);  // a refusal comes before, at 6
}

TEST_CASE("the mouse runs to a place and back, and enters a call in tree and breadcrumb") {
  if (!can_test_window()) return;
  const HandmadeTrace trace;
  Viewer viewer(trace.path(), "1300x850");
  click(200, 611);
  type("key ctrl+a");
  type("type 'edge 0 2'");
  click(50, 638);  // run to next: 7
  type("mousemove 650 300 key l");
  click(100, 109);  // the second row of the tree: the transformation, 4
  type("mousemove 650 300 key l");
  click(900, 153);  // the first crumb: the recursion around it, 3
  type("mousemove 650 300 key l");
  click(1025, 70);  // out: 9
  click(133, 638);  // before: back to 7
  const auto state = viewer.quit();
  CHECK(state["trace"]["bookmarks"] == nlohmann::json{3, 4, 7});
  CHECK(state["trace"]["position"] == 7);
}

TEST_CASE("the mouse goes to a place on the timeline") {
  if (!can_test_window()) return;
  const TracedBall trace;
  const auto end = static_cast<double>(TraceFile(trace.path()).event_count());
  Viewer viewer(trace.path(), "1300x850");
  // The strip lies between the side panels, above the status line.
  type("mousemove 640 640 mousedown 1 mousemove 652 640 mouseup 1");
  const auto state = viewer.quit();
  const auto position = state["trace"]["position"].get<double>();
  CHECK(position / end == doctest::Approx(0.5).epsilon(0.05));
}
