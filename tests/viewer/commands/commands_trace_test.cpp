// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "kernel/error.h"
#include "tests/support/example_traces.h"
#include "tests/viewer/session.h"
#include "viewer/commands/script.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

namespace {

struct TraceSession : TestSession {
  explicit TraceSession(const std::filesystem::path& trace) : TestSession(test::one_tet()) {
    document.open(trace);
  }
};

}  // namespace

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
  CHECK(s.document.scene().tets_shown == all);
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
