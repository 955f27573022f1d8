// SPDX-License-Identifier: MIT
// The window, by keys and mouse.
#include "tests/viewer/window.h"

#include <doctest/doctest.h>

#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::test;
using viewer::count_red;
using viewer::Image;

TEST_CASE("a picture is written by the menu, without the menu") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh");
  const Image by_key = take_picture(".");
  std::filesystem::remove("tetmend-view.png");
  click(24, 11);
  click(120, 97);
  wait_for("tetmend-view.png");
  type("mousemove 500 350");
  CHECK(viewer.quit()["message"] == "wrote tetmend-view.png");
  const Image by_menu = read_png("tetmend-view.png");
  const auto same = [](const viewer::Colour& x, const viewer::Colour& y) { return x == y; };
  CHECK(std::equal(by_menu.pixels.begin() + 1000 * 200, by_menu.pixels.begin() + 1000 * 600,
                   by_key.pixels.begin() + 1000 * 200, same));
}

TEST_CASE("keys and mouse work in the window") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh");
  const Image whole = take_picture(".");
  CHECK(whole.width == 1000);
  CHECK(count_red(whole, 500, 350, 150) > 100);

  type("key b");  // no red any more
  CHECK(count_red(take_picture("."), 500, 350, 150) == 0);
  type("mousemove 480 380 click 1");
  type("key b key x key bracketright");
  type("mousemove 500 350 mousedown 1 mousemove 520 360 mousemove 560 380 mouseup 1");
  // The histogram: the upper left corner of the window.
  type("mousemove 40 140 mousedown 1 mousemove 100 140");
  type("mousemove 150 140 mouseup 1 mousemove 500 350");
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

TEST_CASE("without a file the dialog opens a trace that is typed") {
  if (!can_test_window()) return;
  const HandmadeTrace trace;
  Viewer viewer("", "1000x700");  // it ended the program
  std::filesystem::copy_file(trace.path(), "here.trace");
  type("key ctrl+o");
  type("type here.trace");
  type("key Return");
  type("mousemove 500 350");
  const auto state = viewer.quit();
  CHECK(state["file"].get<std::string>().ends_with("here.trace"));
}

TEST_CASE("in the dialog for files a part of a name and the arrows are enough") {
  if (!can_test_window()) return;
  const HandmadeTrace trace;
  Viewer viewer("", "1000x700");
  for (const char* name : {"first.trace", "other.trace", "third.trace"}) {
    std::filesystem::copy_file(trace.path(), name);
  }
  type("key ctrl+o");
  type("type THE");  // of one alone
  type("key Return");
  wait_until_still();
  type("key ctrl+o");
  type("type trace");
  type("key Down key Down key Down key Return");
  wait_until_still();
  const auto state = viewer.quit();
  CHECK(state["file"].get<std::string>().ends_with("third.trace"));
  REQUIRE(state["recent"].size() == 2);
  CHECK(state["recent"][1].get<std::string>().ends_with("other.trace"));
}

TEST_CASE("the list of keys is searched by typing, and its keys close it") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh");
  wait_until_still();
  type("key F1 type bet");  // each of these letters is a key, too
  type("key F1");
  wait_until_still();  // with the line that tells of the picture
  const Image after = take_picture(".");
  type("key F1 type bet");
  type("key Escape");
  CHECK(is_same(take_picture("."), after));
  type("key e");
  const auto state = viewer.quit();
  CHECK(state["view"]["bad"] == true);
  CHECK(state["view"]["theme"] == "light");
  CHECK(state["view"]["edges"] == false);  // typed when it was closed
}

TEST_CASE("quitting asks where something is unsaved, and Escape stays") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh");
  type("key F6");
  wait_until_still();
  type("key ctrl+q");
  wait_for("tetmend-view.png");
  type("key Escape key b");
  const auto state = viewer.quit();
  CHECK(state["view"]["bad"] == false);  // it went on
  CHECK(state["unsaved"] == true);
  CHECK(state["title"] == "* sheet.mesh - tetmend-view");
}

TEST_CASE("a dialog asks where to go, and says when there is no such place") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh");
  type("key ctrl+g");
  type("type --delay 80 'edge 1'");
  type("key Return");
  type("key ctrl+a");
  type("type --delay 80 'tet 17'");
  type("key Return");
  type("mousemove 500 350");
  const auto state = viewer.quit();
  CHECK(state["selection"]["tet"] == 17);
}

TEST_CASE("a long error is read whole over the picture, and is gone after the next act") {
  if (!can_test_window()) return;
  if (!has_program("ffmpeg")) {
    MESSAGE("tetmend: skipped, because ffmpeg is not installed (see script/bootstrap)");
    return;
  }
  // The key for pictures would be the next act.
  const auto reds_on_screen = [] {
    std::filesystem::remove("screen.png");
    REQUIRE(std::system("ffmpeg -loglevel error -f x11grab -video_size 1280x800 -i $DISPLAY "
                        "-frames:v 1 screen.png") == 0);
    const Image image = read_png("screen.png");
    std::array<int, 2> rows = {image.height, 0};  // of red words, in the upper half
    int last = 0;
    for (int y = 24; y < 300; ++y) {
      int count = 0;
      for (int x = 100; x < 800; ++x) {
        const viewer::Colour& c = image.at(x, y);
        count += c.red > 150 && c.green < 90 && c.blue < 90 ? 1 : 0;
      }
      if (count < 5) continue;
      rows = {std::min(rows[0], y), y};
      last = y;
    }
    return std::pair(rows, last);
  };
  const HandmadeTrace trace;
  Viewer viewer(trace.path(), "1280x800");
  wait_until_still();
  const auto before = reds_on_screen();
  const auto wait_for_reds = [&](const auto& is_wanted) {
    auto reds = reds_on_screen();
    for (int i = 0; i < 100 && !is_wanted(reds); ++i) reds = reds_on_screen();
    return reds;
  };
  type("key ctrl+v");  // what is on the clipboard is no view
  const auto said = wait_for_reds([](const auto& reds) { return reds.second > 0; });
  CHECK(said.second > 0);
  CHECK(said.first[0] < 60);  // at the top of the picture
  type("key e");
  CHECK(wait_for_reds([&](const auto& reds) { return reds == before; }) == before);
  CHECK(viewer.quit()["message"].get<std::string>().find("clipboard") == std::string::npos);
}
