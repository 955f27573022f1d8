// SPDX-License-Identifier: MIT
#include "viewer/debugger/debugger.h"

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "kernel/integrity.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::viewer;

TEST_CASE("the mesh at any place has the handle numbers, tets and points of the run") {
  const test::TracedBall trace;
  Debugger debugger(trace.path());
  Replay truth(debugger.file());
  const std::uint64_t end = debugger.end();
  bool has_holes = false;
  for (const std::uint64_t position : {end / 3, end, end / 2, std::uint64_t{1}, end - 1, end / 5}) {
    debugger.seek(position);
    truth.seek(position);
    const TetMesh mesh = debugger.mesh();
    CHECK(SlotMesh(mesh).fingerprint() == truth.mesh().fingerprint());
    CHECK(mesh.tet_count() == truth.mesh().tet_count());
    has_holes = has_holes || mesh.tet_slots() > mesh.tet_count();
  }
  CHECK(has_holes);
}

TEST_CASE("steps lead on, and back to where they began") {
  const test::TracedBall trace;
  Debugger debugger(trace.path());
  debugger.enter(40);
  const std::uint64_t begin = debugger.position();
  CHECK(debugger.call() == 40);
  for (int i = 0; i < 50; ++i) debugger.step(Step::into, Direction::forward);
  CHECK(debugger.position() == begin + 50);
  for (int i = 0; i < 50; ++i) debugger.step(Step::into, Direction::back);
  CHECK(debugger.position() == begin);
  debugger.step(Step::out, Direction::forward);
  CHECK(debugger.position() == debugger.file().calls()[40].events.end);
}

TEST_CASE("a run stops at the nearest breakpoint that is on, else at the end") {
  const test::HandmadeTrace trace;
  Debugger debugger(trace.path());
  debugger.breakpoints = {{parse_condition("deeper 0")}, {parse_condition("refused"), false}};
  CHECK(debugger.run(Direction::forward) == parse_condition("deeper 0"));
  CHECK(debugger.position() == 7);
  CHECK(debugger.run(Direction::forward) == std::nullopt);
  CHECK(debugger.position() == debugger.end());
  debugger.breakpoints[1].on = true;
  CHECK(debugger.run(Direction::back) == parse_condition("refused"));
  CHECK(debugger.position() == 9);
}

TEST_CASE("a run to a place that is not there stays") {
  const test::HandmadeTrace trace;
  Debugger debugger(trace.path());
  debugger.seek(5);
  CHECK_FALSE(debugger.run_to(parse_condition("accepted"), Direction::forward));
  CHECK(debugger.position() == 5);
  CHECK(debugger.run_to(parse_condition("refused"), Direction::forward));
  CHECK(debugger.position() == 6);
}

TEST_CASE("playing goes on by its speed and stops at breakpoints and at the end") {
  const test::HandmadeTrace trace;
  Debugger debugger(trace.path());
  debugger.speed = 2;
  CHECK_FALSE(debugger.advance(10));  // not playing
  debugger.playing = true;
  CHECK_FALSE(debugger.advance(0.4));
  CHECK(debugger.advance(0.2));
  CHECK(debugger.position() == 1);
  debugger.breakpoints = {{parse_condition("operator shell_transformation")}};
  CHECK(debugger.advance(3));
  CHECK(debugger.position() == 4);
  CHECK_FALSE(debugger.playing);
  debugger.playing = true;
  CHECK(debugger.advance(100));
  CHECK(debugger.position() == debugger.end());
  CHECK_FALSE(debugger.playing);
}

TEST_CASE("what happened last is told in words") {
  const test::HandmadeTrace trace;
  Debugger debugger(trace.path());
  CHECK(debugger.last_event() == "the trace begins");
  debugger.seek(4);
  CHECK(debugger.last_event() == "call 1 begins");
  debugger.seek(8);
  CHECK(debugger.last_event() == "call 2 ends: depth spent");
}

TEST_CASE("the deepest call has the most calls around it") {
  const test::TracedBall trace;
  const Debugger debugger(trace.path());
  const Call& deepest = debugger.file().calls()[debugger.deepest_call()];
  CHECK(deepest.depth > 1);
  for (const Call& call : debugger.file().calls()) CHECK(call.depth <= deepest.depth);
}

TEST_CASE("where a lesson speaks of the tables, steps fill them cell by cell, as its page does") {
  Debugger debugger(TETMEND_SOURCE_DIR "/assets/lessons/4-tables.trace");
  debugger.seek(2);
  const std::size_t cells = debugger.tables().cells.size();
  REQUIRE(cells == 24);  // of 6 corners
  CHECK(debugger.tables().filled == 0);
  for (std::size_t n = 1; n <= cells; ++n) {
    debugger.step(Step::into, Direction::forward);
    CHECK(debugger.position() == 2);
    CHECK(debugger.tables().filled == n);
    CHECK(debugger.polygon().cell->j == debugger.tables().here()->j);
  }
  debugger.step(Step::into, Direction::forward);
  CHECK(debugger.position() == 3);
  CHECK(debugger.tables().filled == cells);  // and they stay so
  CHECK_FALSE(debugger.polygon().cell);
  debugger.step(Step::into, Direction::back);
  CHECK(debugger.position() == 2);
  CHECK(debugger.tables().filled == cells);
  debugger.step(Step::into, Direction::back);
  CHECK(debugger.tables().filled == cells - 1);
  debugger.step(Step::over, Direction::back);
  CHECK(debugger.tables().filled == 0);
  debugger.step(Step::into, Direction::forward);
  for (const std::size_t filled : {7, 13, 19}) {  // the first cells of diagonals
    debugger.step(Step::over, Direction::forward);
    CHECK(debugger.tables().filled == filled);
  }
  debugger.step(Step::over, Direction::forward);
  CHECK(debugger.position() == 3);
}

TEST_CASE("tables that nobody looks at are full, and steps pass over them") {
  const test::TracedBall trace;
  Debugger debugger(trace.path());
  REQUIRE(debugger.run_to(parse_condition("operator shell_transformation"), Direction::forward));
  const std::uint64_t begin = debugger.position();
  CHECK(debugger.tables().filled == debugger.tables().cells.size());
  debugger.step(Step::into, Direction::forward);
  CHECK(debugger.position() == begin + 1);
  debugger.shows_tables = true;
  debugger.seek(begin);
  CHECK(debugger.tables().filled == 0);
  debugger.step(Step::into, Direction::forward);
  CHECK(debugger.position() == begin);
  CHECK(debugger.tables().filled == 1);
}
