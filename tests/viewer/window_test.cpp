// SPDX-License-Identifier: MIT
// The window, by keys and mouse.
#include "tests/viewer/window.h"

#include <doctest/doctest.h>

using namespace tetmend;
using namespace tetmend::test;
using viewer::count_red;
using viewer::Image;

TEST_CASE("keys and mouse work in the window") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh");
  const Image whole = take_picture(".");
  CHECK(whole.width == 1000);
  CHECK(count_red(whole, 500, 350, 150) > 100);

  type("mousemove 480 380 click 1");
  type("key b");  // no red any more
  CHECK(count_red(take_picture("."), 500, 350, 150) == 0);
  type("key b key x key bracketright");
  type("mousemove 500 350 mousedown 1 mousemove 520 360 mousemove 560 380 mouseup 1 sleep 0.5");
  // The histogram: the upper left corner of the window.
  type("mousemove 40 140 sleep 0.3 mousedown 1 sleep 0.3 mousemove 100 140 sleep 0.3");
  type("mousemove 150 140 sleep 0.3 mouseup 1 sleep 0.3 mousemove 500 350");
  const Image last = take_picture(".");
  CHECK(last.pixels != whole.pixels);
  const nlohmann::json state = viewer.quit();
  CHECK(state["view"]["cut_1"]["on"] == true);
  CHECK(static_cast<double>(state["view"]["cut_1"]["position"]) == doctest::Approx(0.02));
  CHECK(static_cast<double>(state["view"]["camera"]["yaw"]) != -55);
  CHECK(state["selection"]["kind"] != "nothing");
  CHECK(state["view"]["filtered"] == true);
  CHECK(state["view"]["range"][1] > state["view"]["range"][0]);
  CHECK(state["shown"] < state["tets"]);
}
