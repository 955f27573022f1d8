// SPDX-License-Identifier: MIT
// How many keys and clicks a question takes, in a window of 1280 x 800.
#include <algorithm>
#include <array>
#include <limits>

#include <doctest/doctest.h>

#include "kernel/formats/mesh_io.h"
#include "tests/support/example_traces.h"
#include "tests/viewer/window.h"
#include "trace/ledger.h"
#include "trace/run_comparison.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

constexpr const char* kSize = "1280x800";
constexpr int kFirstFound = 620;  // height of the first of the calls found

/// Moving the mouse is no action; a key and a click are.
class Hand {
 public:
  void key(const std::string& name) {
    type("key " + name);
    ++actions;
  }
  void click(int x, int y, int button = 1) {
    type(fmt::format("mousemove {} {} sleep 0.2 click {} sleep 0.2", x, y, button));
    ++actions;
  }
  static void move(int x, int y) { type(fmt::format("mousemove {} {} sleep 0.4", x, y)); }
  int actions = 0;
};

/// A run over the ball of TracedBall.
void record_smoothing(const std::string& trace) {
  TetMesh mesh(delaunay_ball(120, 3));
  record(mesh, trace, {}, {}, Schedule("brief", "smooth{}"));
}

}  // namespace

TEST_CASE(
    "who refused most is there when a trace opens, and all those refusals are one click away") {
  if (!can_test_window()) return;
  const TracedBall trace;
  const TraceFile file(trace.path());
  const Ledger ledger = make_ledger(file);
  std::vector<LedgerRow> rows = ledger.by_operator();
  std::stable_sort(rows.begin(), rows.end(), [](const LedgerRow& a, const LedgerRow& b) {
    return a.refused().calls > b.refused().calls;
  });
  Viewer viewer(trace.path(), kSize);
  wait_until_still();
  Hand hand;
  hand.click(1245, 170);  // what the first row has under "refused"
  CHECK(hand.actions <= 2);
  SUBCASE("listed") {
    const auto state = viewer.quit();
    CHECK(state["trace"]["found"]["condition"] ==
          fmt::format("operator {} and refused", rows.front().operator_name));
    CHECK(state["trace"]["found"]["calls"] == rows.front().refused().calls);
  }
  SUBCASE("and in sight, the nearest to being accepted first") {
    wait_until_still();
    hand.click(950, kFirstFound);
    CHECK(hand.actions <= 2);
    const auto state = viewer.quit();
    REQUIRE(state["trace"]["call"].is_object());
    const Call& entered = file.calls()[state["trace"]["call"]["number"].get<std::size_t>()];
    CHECK(file.name(entered.operator_name) == rows.front().operator_name);
    double least = std::numeric_limits<double>::infinity();
    for (const Call& call : file.calls()) {
      const bool is_one = file.name(call.operator_name) == rows.front().operator_name &&
                          call.verdict && !call.accepted();
      if (is_one) least = std::min(least, call.missing());
    }
    CHECK(entered.missing() == least);
  }
}

TEST_CASE("an operator tried by clicks and undone by one leaves the bytes that Save writes") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh", kSize);
  const auto save = [](const std::string& name) {
    const std::filesystem::path file = std::filesystem::current_path() / name;
    type("key ctrl+s type " + file.string());
    type("key Return");
    wait_for(file);
    wait_until_still();  // it is written whole
    return read_text(file);
  };
  const std::string before = save("before.mesh");
  Hand hand;
  hand.click(640, 400, 3);
  Hand::move(670, 458);  // Try ...
  hand.click(830, 460);
  wait_until_still();
  hand.click(976, 166);  // Undo, which is there as the trial was accepted
  CHECK(hand.actions == 3);
  CHECK(save("after.mesh") == before);
  const std::filesystem::path converted = std::filesystem::current_path() / "converted.mesh";
  write_mesh(converted, read_mesh(TETMEND_SOURCE_DIR "/assets/meshes/sheet.mesh"));
  CHECK(read_text(converted) == before);
  const auto state = viewer.quit();
  CHECK(state["trial"].is_null());
  CHECK(state["unsaved"] == false);
  CHECK(state["tets"] == 3327);
}

TEST_CASE("what is tried again with a parameter of the panel, and then kept, is not saved yet") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh", kSize);
  Hand hand;
  hand.click(640, 400, 3);
  Hand::move(670, 458);
  hand.click(830, 460);
  wait_until_still();
  hand.click(1245, 193);  // one more ring of vertices
  wait_until_still();
  hand.click(921, 166);  // Keep
  const auto state = viewer.quit();
  CHECK(state["trial"].is_null());
  CHECK(state["unsaved"] == true);
}

TEST_CASE("an operator is tried on a picked tet by two clicks") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh", kSize);
  wait_until_still();
  Hand hand;
  hand.click(640, 400, 3);
  Hand::move(670, 458);  // Try ...
  hand.click(830, 460);  // the first operator for tets
  CHECK(hand.actions == 2);
  Hand::move(640, 300);
  const auto state = viewer.quit();
  REQUIRE(state["trial"].is_object());
  CHECK(state["trial"]["target"].size() == 4);
  CHECK(state["trial"]["seconds"] < 0.1);
}

TEST_CASE("keys are for the picture again when Escape has closed a menu of operators") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh", kSize);
  wait_until_still();
  Hand hand;
  hand.click(640, 400, 3);
  Hand::move(670, 458);  // Try ...
  hand.key("Escape");
  wait_until_still();
  hand.key("o");
  const auto state = viewer.quit();
  CHECK(state["trial"].is_null());
  CHECK(state["view"]["camera"]["orthographic"] == true);
}

TEST_CASE("pause, three calls back, explain, another parameter, go on: six actions") {
  if (!can_test_window()) return;
  Viewer viewer("sheet.mesh", kSize);
  constexpr std::array kStrip = {600, 770};  // where the number of events stands
  const auto press = [&](const char* key) {
    const viewer::Image before = take_picture(".");
    type(fmt::format("key {}", key));
    wait_for_change(before, kStrip[0], kStrip[1]);
  };
  press("shift+F6");  // always the same calls: F7 would come at any of them
  for (int i = 0; i < 8; ++i) press("F9");
  Hand hand;
  const viewer::Image paused = take_picture(".");
  hand.key("F9");  // goes on, and is held at the next change
  wait_for_change(paused, kStrip[0], kStrip[1]);
  for (int i = 0; i < 3; ++i) hand.key("Up");
  wait_until_still();     // why it ended as it did stands beside the picture
  hand.click(1245, 145);  // one more step for each vertex
  hand.key("F8");
  CHECK(hand.actions <= 6);
  const auto state = viewer.quit();
  CHECK(state["held_parameters"] == nlohmann::json{"mean_smoothing: steps = 3"});
}

TEST_CASE("two runs stand side by side by a key and a name") {
  if (!can_test_window()) return;
  const TracedBall trace;
  TempFolder folder;
  const std::string other = (folder / "other.trace").string();
  record_smoothing(other);
  Viewer viewer(trace.path(), kSize);
  wait_until_still();
  Hand hand;
  hand.key("ctrl+b");
  type("type " + other);
  hand.key("Return");
  CHECK(hand.actions <= 2);
  wait_until_still();
  const auto state = viewer.quit();
  REQUIRE(state["trace"]["against"].is_object());
  CHECK(state["trace"]["against"]["file"] == other);
}

TEST_CASE("two runs stand side by side by the command alone, and one click unfolds an operator") {
  if (!can_test_window()) return;
  const TracedBall trace;
  TempFolder folder;
  const std::string other = (folder / "other.trace").string();
  record_smoothing(other);
  const RunComparison wanted = compare_runs(TraceFile(trace.path()), TraceFile(other));
  Viewer viewer(trace.path(), kSize, "1", {"--against", other});
  wait_until_still();
  Hand hand;
  constexpr int kFirstRow = 333;  // below both runs over time
  hand.click(912, kFirstRow);     // its triangle
  const viewer::Image unfolded = take_picture(".");
  hand.click(912, kFirstRow);
  const viewer::Image folded = take_picture(".");
  const auto different = [&](int x, int y) { return unfolded.at(x, y).red != folded.at(x, y).red; };
  int count = 0;
  for (int y = 350; y < 650; ++y) count += different(1240, y) || different(1100, y) ? 1 : 0;
  CHECK(count > 5);  // rows of the ways to end
  const auto state = viewer.quit();
  REQUIRE(state["trace"]["against"].is_object());
  CHECK(state["trace"]["against"]["bad_here"] == wanted.bad_in_a);
  CHECK(state["trace"]["against"]["bad_there"] == wanted.bad_in_b);
  CHECK(state["trace"]["against"]["bad_here_good_there"] == wanted.worse_in_a.size());
}
