// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/error.h"
#include "tests/support/example_traces.h"
#include "tests/viewer/session.h"
#include "viewer/commands/script.h"
#include "viewer/debugger/call_highlight.h"
#include "viewer/debugger/tets_drawing.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;
using test::TraceSession;

TEST_CASE("a trace is opened like a mesh, and a mesh after it closes it") {
  const test::TracedBall trace;
  TraceSession s(trace.path());
  REQUIRE(s.document.debugger() != nullptr);
  CHECK(s.document.mesh().tet_count() == s.document.debugger()->file().initial_mesh().tet_count());
  s.document.set_mesh(TetMesh(test::one_tet()), "one.mesh");
  CHECK(s.document.debugger() == nullptr);
  CHECK_THROWS_WITH_AS(s.run("step_into"), doctest::Contains("no trace"), Error);
}

TEST_CASE("the document shows the mesh, the numbers and the target of the place in the trace") {
  const test::TracedBall trace;
  TraceSession s(trace.path());
  const std::size_t bad = s.document.statistics().n_bad;
  s.run("seek", {s.document.debugger()->end()});
  CHECK(s.document.statistics().n_bad < bad);
  CHECK(SlotMesh(s.document.mesh()).fingerprint() ==
        SlotMesh(s.document.debugger()->mesh()).fingerprint());
  s.run("to_begin");
  CHECK(s.document.statistics().n_bad == bad);
  s.run("run_to", {"operator shell_transformation"});
  const auto state = state_of(s.document);
  CHECK(state["selection"]["kind"] == "edge");
  const auto& target = state["trace"]["call"]["target"];
  CHECK((target[0] == state["selection"]["from"] || target[1] == state["selection"]["from"]));
}

TEST_CASE("isolating shows the tets of the call and no others") {
  const test::TracedBall trace;
  TraceSession s(trace.path());
  s.run("run_to", {"operator shell_transformation"});
  s.run("isolate");  // it is on at first
  const std::size_t all = s.document.scene().tets_shown;
  CHECK(all == s.document.mesh().tet_count());
  s.run("isolate");
  const auto& call = *s.document.debugger()->study();
  CHECK(s.document.scene().tets_shown == call.before.size());
  CHECK(call.before.size() < all);
  s.run("to_begin");  // no call: nothing to isolate
  CHECK(s.document.scene().tets_shown == s.document.mesh().tet_count());
}

TEST_CASE("a script steps into, over and out, back again, and to breakpoints") {
  const test::HandmadeTrace trace;
  TraceSession s(trace.path());
  run_script(s.session, R"lua(
    local function at() return state().trace.position end
    step_into(); step_into(); step_into()
    expect(at() == 3 and state().trace.call.level == 0, "in the recursion")
    expect(step("over") == 6, "over the transformation")
    expect(step("over", "back") == 3, "and back over it")
    step_into()
    expect(step_out() == 6, "out")
    expect(back_out() == 2, "back out of the recursion")
    expect(run_to("deeper 0") and at() == 7, "deeper")
    expect(not run_to("accepted"), "nothing accepted")
    expect(run_to("edge 0 1", "back") and at() == 4, "back to the edge")
    to_begin()
    breakpoint("refused")
    run()
    expect(at() == 6, "stopped")
    run()
    expect(at() == 8, "stopped again")
    run_back()
    expect(at() == 6, "and backwards")
    breakpoint("refused")
    expect(#state().trace.breakpoints == 0, "taken away")
    run()
    expect(at() == 11, "at the end")
    seek(5)
    bookmark("here")
    seek(9)
    bookmark()
    to_begin()
    next_bookmark()
    expect(at() == 5, "first mark")
    next_bookmark()
    expect(at() == 9, "second mark")
    last_bookmark()
    expect(at() == 5, "first mark again")
    enter(2)
    expect(at() == 7 and #state().trace.stack == 2, "call 2 and the one around it")
    expect(state().trace.stack[1].line == 12 and state().trace.call.line == 1, "lines")
    next_refused()
    expect(state().trace.call.verdict == "depth spent", "the verdict")
  )lua",
             "test");
}

TEST_CASE("moves in a trace tell what is wrong with their arguments") {
  const test::HandmadeTrace trace;
  TraceSession s(trace.path());
  CHECK_THROWS_WITH_AS(s.run("seek", {12}), doctest::Contains("has 11 events"), Error);
  CHECK_THROWS_WITH_AS(s.run("step", {"under"}), doctest::Contains("into, over, out"), Error);
  CHECK_THROWS_WITH_AS(s.run("step", {"into", "up"}), doctest::Contains("forward or back"), Error);
  CHECK_THROWS_WITH_AS(s.run("enter", {3}), doctest::Contains("from 0 to 2"), Error);
  CHECK_THROWS_WITH_AS(s.run("next_lesson_step"), doctest::Contains("no lesson"), Error);
  CHECK_THROWS_WITH_AS(s.run("last_bookmark"), doctest::Contains("no further"), Error);
}

TEST_CASE("steps of a lesson at one place of the trace are one step, forwards and backwards") {
  const test::HandmadeTrace trace;
  test::write_text(trace.folder / "by_hand.json",
                   R"({"title": "T", "trace": "by_hand.trace", "steps": [
                       {"at": 0, "text": "a", "focus": ["tree"]}, {"at": 3, "text": "b"},
                       {"at": 3, "text": "c", "ask": {"kind": "line", "text": "Which?"}},
                       {"at": 8, "text": "d"}]})");
  TraceSession s(trace.path());
  const auto position = [&] { return s.document.debugger()->position(); };
  std::vector<std::uint64_t> way;
  for (int i = 0; i < 2; ++i) {
    s.run("next_lesson_step");
    way.push_back(position());
  }
  CHECK_THROWS_WITH_AS(s.run("next_lesson_step"), doctest::Contains("end of the lesson"), Error);
  for (int i = 0; i < 2; ++i) {
    s.run("last_lesson_step");
    way.push_back(position());
  }
  CHECK(way == std::vector<std::uint64_t>{3, 8, 3, 0});
  CHECK_THROWS_WITH_AS(s.run("last_lesson_step"), doctest::Contains("beginning of the lesson"),
                       Error);
}

TEST_CASE("the camera finds each isolated call, and what is isolated is never nothing") {
  const test::TracedBall trace;
  TraceSession s(trace.path());
  const std::size_t calls = s.document.debugger()->file().calls().size();
  REQUIRE(calls > 100);
  for (std::size_t k = 0; k < 300 && k < calls; ++k) {
    CAPTURE(k);
    s.run("enter", {k});
    REQUIRE(s.document.view.scene.isolate);
    CHECK(s.document.scene().tets_shown > 0);
    const auto ball = ball_around(*s.document.debugger()->study());
    if (!ball) continue;
    const auto at = s.document.view.camera.project(ball->centre, s.document.canvas);
    REQUIRE(at);
    CHECK(at->x > 0);
    CHECK(at->x < s.document.canvas.width);
    CHECK(at->y > 0);
    CHECK(at->y < s.document.canvas.height);
    // Most of it, not its middle alone.
    const Canvas canvas = s.document.canvas;
    std::size_t corners = 0, seen = 0;
    for (const LocalTet& tet : s.document.debugger()->study()->before) {
      for (const Point& p : tet.corners) {
        const auto corner = s.document.view.camera.project(to_glm(p), canvas);
        ++corners;
        seen += corner && corner->x > 0 && corner->y > 0 && corner->x < canvas.width &&
                        corner->y < canvas.height
                    ? 1
                    : 0;
      }
    }
    CHECK(10 * seen >= 7 * corners);
  }
}

TEST_CASE(
    "what is picked in a trace and isolated is brought into sight, the rest around it an outline") {
  const test::TracedBall trace;
  TraceSession s(trace.path());
  s.run("to_end");
  s.run("home");
  s.document.view.camera.distance *= 10;  // a tet is a dot
  const Camera before = s.document.view.camera;
  REQUIRE(s.document.scene().tets_shown > 1);
  s.document.select(TetHandle(s.document.worst().front()));
  CHECK(s.document.scene().tets_shown > 1);  // only pointed out
  s.run("isolate");
  CHECK(s.document.scene().tets_shown == 1);
  REQUIRE(s.document.outline() != nullptr);
  CHECK(s.document.outline()->surface.size() > 100);
  const auto share = [&] {
    double high = -1e9, low = 1e9;
    for (const auto& corner : corners(s.document.mesh(), s.document.worst().front())) {
      const auto at = s.document.view.camera.project(corner, s.document.canvas);
      REQUIRE(at);
      high = std::max({high, at->x, at->y});
      low = std::min({low, at->x, at->y});
    }
    return (high - low) / s.document.canvas.height;
  };
  CHECK(share() > 0.1);
  s.run("isolate");
  CHECK(s.document.scene().tets_shown > 1);
  CHECK(s.document.outline() == nullptr);
  CHECK(s.document.view.camera == before);
}

TEST_CASE("before its first call a lesson has the numbers of its vertices in the picture") {
  TestSession s(test::one_tet());
  s.document.open(TETMEND_SOURCE_DIR "/assets/lessons/2-two-shells.json");
  REQUIRE(s.document.debugger()->call() == kNoCall);
  CHECK(s.document.names().size() == s.document.mesh().vertex_count());
}

TEST_CASE("what a call makes is not shown before it has found it, and then as found") {
  const test::TracedBall trace;
  TraceSession s(trace.path());
  const auto has_chords = [&] {
    const auto& lines = s.document.highlighted().lines;
    return std::any_of(lines.begin(), lines.end(),
                       [](const Line& line) { return line.colour == kChordColour; });
  };
  Debugger& debugger = *s.document.debugger();
  unsigned seen = 0;
  for (std::uint32_t k = 0; k < debugger.file().calls().size() && seen < 5; ++k) {
    if (debugger.file().calls()[k].algorithm != Algorithm::shell_transformation) continue;
    s.run("enter", {k});
    const CallStudy study = *debugger.study();
    if (!study.covering || study.covering->triangles.empty()) continue;
    ++seen;
    const auto is_told = [&](std::string_view tense) {
      const auto& legend = s.document.legend();
      return std::any_of(legend.begin(), legend.end(), [&](const LegendEntry& entry) {
        return entry.colour == kChordColour && entry.text.ends_with(tense);
      });
    };
    REQUIRE(study.found);
    s.run("seek", {*study.found - 1});
    CHECK_FALSE(has_chords());
    s.run("seek", {study.first_edit - 1});
    CHECK(has_chords());
    CHECK(is_told("found"));
    s.run("seek", {study.first_edit});
    if (debugger.call() == k) CHECK(has_chords());
    CHECK_FALSE(is_told("found"));
  }
  CHECK(seen == 5);
}

TEST_CASE("questions of a lesson are answered once, and the answers stay") {
  TraceSession s(TETMEND_SOURCE_DIR "/assets/lessons/1-core.trace");
  Debugger& debugger = *s.document.debugger();
  CHECK_THROWS_WITH_AS(s.run("answer", {"accepted"}), doctest::Contains("no question is open here"),
                       Error);
  s.run("seek", {2});
  CHECK_THROWS_WITH_AS(s.run("answer"), doctest::Contains("answer: argument 1 must be a text"),
                       Error);
  CHECK_THROWS_WITH_AS(s.run("answer", {7}), doctest::Contains("expected accepted or refused"),
                       Error);
  CHECK(debugger.score() == std::array<std::size_t, 2>{0, 0});
  const auto told = s.run("answer", {"refused"});
  CHECK(told["right"] == true);
  CHECK(told["why"].get<std::string>().starts_with("It ends: no improvement."));
  CHECK_THROWS_AS(s.run("answer", {"accepted"}), Error);
  s.run("seek", {6});
  const std::array<std::uint32_t, 2> side = {2, 3};
  CHECK(s.run("answer", {fmt::format("{} {}", side[0], side[1])})["right"] == false);
  CHECK(debugger.score() == std::array<std::size_t, 2>{2, 1});
  s.run("seek", {7});
  const auto steps = debugger.lesson()->steps;
  const auto asking =
      std::find_if(steps.begin(), steps.end(), [](const LessonStep& step) { return step.at == 7; });
  const auto number = debugger.question_of(static_cast<std::size_t>(asking - steps.begin()));
  REQUIRE(number != nullptr);
  CHECK(s.run("answer", {number->question.number})["right"] == true);
  s.run("seek", {2});
  CHECK(debugger.question_of(1)->is_right == true);
}

TEST_CASE("each colour of a visit and of a call at a vertex has one entry in the legend") {
  const test::TracedBall trace;
  TraceSession s(trace.path());
  const auto check_once = [&](const std::vector<Colour>& wanted) {
    const std::vector<LegendEntry> entries = s.document.legend();
    for (const Colour& colour : wanted) {
      CHECK(std::count_if(entries.begin(), entries.end(),
                          [&](const LegendEntry& entry) { return entry.colour == colour; }) == 1);
    }
    return entries.back().text;
  };
  s.run("run_to", {"visit 1"});
  REQUIRE(std::holds_alternative<TetHandle>(s.document.selection()));
  CHECK(check_once({kSelectionColour}) == "tets beside it");
  CHECK(s.document.legend().front().text == "tet t that the pass turns to, visit 1");
  unsigned seen = 0;
  const auto calls = s.document.debugger()->file().calls();
  for (std::uint32_t k = 0; k < calls.size() && seen < 4; ++k) {
    if (calls[k].target_size != 1 || !calls[k].candidate_found) continue;
    ++seen;
    s.run("enter", {k});
    CHECK(check_once({kSupportingEdgeColour, kSkirtColour}) == "tets before the call");
    s.run("seek", {calls[k].events.end});
    if (s.document.debugger()->call() != k || calls[k].edits == 0) continue;
    CHECK(check_once({kSupportingEdgeColour, kSkirtColour}) ==
          (calls[k].accepted() ? "tets after the call" : "tets as before: undone"));
  }
  CHECK(seen == 4);
}

TEST_CASE("a step of the recursion shows the shell of its caller and the face to remove") {
  TraceSession s(TETMEND_SOURCE_DIR "/assets/lessons/2-two-shells.trace");
  CHECK(s.document.teaching);
  s.run("seek", {2});
  CHECK(state_of(s.document)["trace"]["removal"] == "to remove: edge e = 0 1, level 0");
  s.run("seek", {9});
  const auto state = state_of(s.document);
  CHECK(state["trace"]["removal"] == "to remove: face f = 0 1 5 at its link edge e = 1 5, level 1");
  const auto has = [&](const char* text) {
    const auto& legend = state["legend"];
    return std::find(legend.begin(), legend.end(), text) != legend.end();
  };
  CHECK(has("shell of the caller, 0 1"));
  CHECK(has("face f to remove, 0 1 5"));
  const auto& faces = s.document.highlighted().faces;
  CHECK(std::any_of(faces.begin(), faces.end(), [](const SurfaceVertex& v) {
    return v.colour.red == kFaceToRemoveColour.red && v.colour.blue == kFaceToRemoveColour.blue;
  }));
  std::set<std::string> roles;
  for (const auto& name : state["names"]) roles.insert(name["role"].get<std::string>());
  for (const char* role : {"a", "b", "p1", "p2", "p3"}) CHECK(roles.contains(role));
  s.run("point_at", {"call 0"});
  CHECK(state_of(s.document)["pointed"].size() == 2);
  s.run("step_into");
  CHECK(s.document.pointed().is_nothing());
}
