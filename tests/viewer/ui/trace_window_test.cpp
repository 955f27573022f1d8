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
  type("mousemove 650 300 key Right Right Right");  // outside of calls the ledger is on top
  wait_until_still();
  for (const char* place : {"refused", "deeper 0", "accepted"}) {
    click(200, 317);  // the place to run to
    type("key ctrl+a");
    type(fmt::format("type --delay 80 '{}'", place));
    click(254, 344);  // breakpoint
  }
  // Now there is a row for each, 27 pixels high.
  click(18, 371);   // "refused" is off
  click(414, 425);  // "accepted" is gone
  click(1071, 70);  // run
  const auto state = viewer.quit();
  CHECK(state["trace"]["breakpoints"] == nlohmann::json{"refused", "deeper 0"});
  CHECK(state["trace"]["position"] == 7);  // a refusal comes before, at 6
}

TEST_CASE("the mouse runs to a place and back, and enters a call in tree and breadcrumb") {
  if (!can_test_window()) return;
  const HandmadeTrace trace;
  Viewer viewer(trace.path(), "1300x850");
  type("mousemove 650 300 key Right Right Right");
  wait_until_still();
  click(200, 317);
  type("key ctrl+a");
  type("type --delay 80 'edge 0 2'");
  click(88, 344);  // run to next: 7
  type("mousemove 650 300 key l");
  click(100, 109);  // the second row of the tree: the transformation, 4
  type("mousemove 650 300 key l");
  click(900, 153);  // the first crumb: the recursion around it, 3
  type("mousemove 650 300 key l");
  click(1025, 70);  // out: 9
  click(172, 344);  // before: back to 7
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

namespace {

/// The fifth step of the lesson on two shells, with all panels: the recursion for edge 1 5 begins.
void go_to_second_shell() {
  type("mousemove 650 300 key shift+t");
  for (int i = 0; i < 4; ++i) type("key shift+l");
}

const std::filesystem::path kLesson = TETMEND_SOURCE_DIR "/assets/lessons/2-two-shells.trace";

}  // namespace

TEST_CASE("in a small window, and with large text there, buttons of steps are in sight in a call") {
  if (!can_test_window()) return;
  struct Place {
    const char* scale;
    int x, into, back;
  };
  for (const Place& place : {Place{"1", 960, 397, 425}, Place{"1.5", 800, 518, 558}}) {
    CAPTURE(place.scale);
    Viewer viewer(kLesson, "1280x720", place.scale);
    go_to_second_shell();
    wait_until_still();
    click(place.x, place.into);
    click(place.x, place.into);
    click(place.x, place.back);
    const auto state = viewer.quit();
    CHECK(state["trace"]["position"] == 9);
    CHECK(state["trace"]["call"]["operator"] == "shell_transformation");
  }
}

TEST_CASE("what the mouse is on is pointed at: in tree, icicles, breadcrumb, ring and picture") {
  if (!can_test_window()) return;
  struct Place {
    int x, y;
    std::vector<std::uint32_t> vertices;
  };
  const std::vector<Place> places = {{200, 109, {0, 1}},   // second row of the tree
                                     {550, 748, {0, 1}},   // the same call in the icicles
                                     {1060, 302, {1, 5}},  // the second crumb
                                     {134, 484, {0}},      // the name of a corner of the ring
                                     {616, 398, {0}},      // the vertex in the picture
                                     {700, 150, {}}};      // nothing
  for (const Place& place : places) {
    CAPTURE(place.x);
    CAPTURE(place.y);
    Viewer viewer(kLesson, "1300x850");
    go_to_second_shell();
    wait_until_still();  // panels have moved
    type(fmt::format("mousemove {} {}", place.x, place.y));
    wait_until_still();  // with the mouse there
    const auto state = viewer.quit();
    CHECK(state["trace"]["position"] == 8);
    CHECK(state["pointed"] == nlohmann::json(place.vertices));
  }
}

TEST_CASE("on a screen of 3840 x 2160 with text twice as large the mouse hits what it is on") {
  if (!can_test_window()) return;
  Viewer viewer(kLesson, "3840x2160", "2");
  type("mousemove 1900 900 key shift+t");
  for (int i = 0; i < 4; ++i) type("key shift+l");
  type("mousemove 3080 572 click 1");  // the first crumb: the recursion for edge 0 1
  type("mousemove 1900 900 key l");
  type("mousemove 400 218 click 1");  // the second row of the tree: its transformation
  const auto state = viewer.quit();
  CHECK(state["trace"]["bookmarks"] == nlohmann::json{2});
  CHECK(state["trace"]["position"] == 4);
}

TEST_CASE("a mesh is opened by the dialog while a lesson is shown") {
  if (!can_test_window()) return;
  Viewer viewer(kLesson, "1280x800");
  wait_until_still();
  type("key ctrl+o type " TETMEND_SOURCE_DIR "/assets/meshes/sheet.mesh");
  type("key Return");
  wait_until_still();
  const auto state = viewer.quit();
  CHECK(state["trace"].is_null());
  CHECK(state["tets"] == 3327);
}

TEST_CASE("a right click goes to what the mouse is on, or asks for its history") {
  if (!can_test_window()) return;
  SUBCASE("to the call of a bar of the icicles") {
    Viewer viewer(kLesson, "1300x850");
    go_to_second_shell();
    type("mousemove 550 748 click 3");
    click(575, 747);  // Go to call 1
    CHECK(viewer.quit()["trace"]["position"] == 4);
  }
  SUBCASE("to the edge that it aimed at") {
    Viewer viewer(kLesson, "1300x850");
    go_to_second_shell();
    type("mousemove 550 748 click 3");
    click(575, 789);  // Go to this edge
    const auto state = viewer.quit();
    CHECK(state["trace"]["position"] == 8);
    CHECK(state["selection"]["kind"] == "edge");
    CHECK(state["selection"]["from"].get<int>() + state["selection"]["to"].get<int>() == 1);
  }
  SUBCASE("the history of a vertex of the ring") {
    Viewer viewer(kLesson, "1300x850");
    go_to_second_shell();
    type("mousemove 134 484 click 3");
    click(160, 563);  // History of this vertex
    CHECK(viewer.quit()["message"] == "the history of vertex:0 is in the panel History");
  }
  SUBCASE("Escape closes the menu, and nothing else") {
    Viewer viewer(kLesson, "1300x850");
    go_to_second_shell();
    type("mousemove 550 748 click 3");
    type("key Escape");
    click(575, 805);
    const auto state = viewer.quit();
    CHECK(state["selection"]["kind"] == "edge");  // that of the call at hand, as before
    CHECK(state["selection"]["from"].get<int>() + state["selection"]["to"].get<int>() == 6);
  }
}

TEST_CASE("a click on a call that a history names goes there") {
  if (!can_test_window()) return;
  const TracedBall trace;
  // With two columns, and with one in tabs, where the answer comes to the front.
  std::string size;
  int column = 0;
  SUBCASE("two columns") {
    size = "1300x850";
    column = 858;
  }
  SUBCASE("one column") {
    size = "1280x800";
    column = 898;
  }
  Viewer viewer(trace.path(), size);
  type("mousemove 650 300 key w key shift+h");
  wait_until_still();
  const viewer::Image image = take_picture(".");
  // The first word in the colour of links in the right column, as far as its text goes.
  const auto is_link = [&](int x, int y) {
    const viewer::Colour& c = image.at(x, y);
    return c.red < 70 && c.green > 80 && c.green < 130 && c.blue > 180 && c.blue < 220;
  };
  int left = image.width, right = 0, line = -1;
  for (int y = 50; y < 600 && (line < 0 || y < line + 12); ++y) {
    for (int x = column; x < 1262; ++x) {
      if (!is_link(x, y)) continue;
      if (line < 0) line = y;
      left = std::min(left, x);
      right = std::max(right, x);
    }
  }
  REQUIRE(line > 0);
  REQUIRE(right - left > 25);
  click((left + right) / 2, line + 6);
  const auto state = viewer.quit();
  REQUIRE(state["trace"]["call"].is_object());
  const auto number = state["trace"]["call"]["number"].get<std::uint32_t>();
  const TraceFile file(trace.path());
  CHECK(state["trace"]["position"] == file.calls()[number].events.begin + 1);
}
