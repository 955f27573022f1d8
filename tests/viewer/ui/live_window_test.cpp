// SPDX-License-Identifier: MIT
// A run in the window, by keys.
#include <doctest/doctest.h>

#include "kernel/formats/mesh_io.h"
#include "tests/support/zoo.h"
#include "tests/viewer/window.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("in the window a run takes the red away") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh");
  const std::size_t before = viewer::count_red(take_picture("."), 500, 350, 150);
  REQUIRE(before > 100);
  type("key F6");
  std::size_t now = before;
  for (int i = 0; i < 300 && now > before / 10; ++i) {
    now = viewer::count_red(take_picture("."), 500, 350, 150);
  }
  CHECK(now <= before / 10);
  CHECK(viewer.quit()["run"] != "idle");
}

TEST_CASE("the window serves keys while a run works, and closes on one that is paused") {
  if (!can_test_window()) return;
  const TempFolder folder;
  write_mesh(folder / "large.meshb", kuhn_cube(32, 0.3, 1));  // a run of seconds: F7 comes in time
  Viewer viewer(folder / "large.meshb");
  const auto whole = take_picture(".");
  type("key F6 key F7");
  wait_until_still();  // held
  const auto held = take_picture(".");
  type("key F9");
  wait_for_change(held, 0, held.height);
  type("key F10 key b");
  CHECK(take_picture(".").pixels != whole.pixels);
  const nlohmann::json state = viewer.quit();
  CHECK((state["run"] == "paused" || state["run"] == "running"));
  CHECK(state["view"]["bad"] == false);
}

TEST_CASE("in the window a run is recorded, and opened in the debugger when it is over") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh");
  click(800, 300);  // unfolds the panel
  click(729, 570);  // record
  click(737, 597);  // run
  wait_for("tetmend-live.trace");
  type("mousemove 500 350");
  wait_until_still();  // its last mesh is shown
  click(890, 617);     // debug this run
  type("key d");       // the mesh of the run is not saved: let it go
  type("mousemove 500 350 key Right Right Right Right");
  const nlohmann::json state = viewer.quit();
  REQUIRE(state["trace"].is_object());
  CHECK(state["trace"]["position"] == 4);
  CHECK(state["trace"]["call"]["operator"] == "mean_smoothing");
}

TEST_CASE("a mesh is saved by the dialog") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh");
  const std::filesystem::path file = std::filesystem::current_path() / "better.mesh";
  type("key ctrl+s type " + file.string());
  type("key Return");
  wait_for(file);
  CHECK(read_mesh(file).tets.size() == 3327);
  CHECK(viewer.quit()["message"] == "wrote " + file.string());
}
