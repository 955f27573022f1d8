// SPDX-License-Identifier: MIT
#include "viewer/debugger/condition.h"

#include <algorithm>
#include <array>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/error.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::viewer;

namespace {

constexpr auto kForward = Direction::forward;
constexpr auto kBack = Direction::back;

std::optional<std::uint64_t> stop(const TraceFile& file, const std::string& text,
                                  std::uint64_t from, Direction direction = kForward) {
  Replay replay(file);
  return find_stop({file, replay}, parse_condition(text), from, direction);
}

}  // namespace

TEST_CASE("a condition is written as it is read") {
  for (const char* text :
       {"accepted", "accepted for good", "undone", "refused", "deeper 2", "operator edge_removal",
        "edge 3 17", "face 1 2 3", "vertex 5", "tet 4711", "level 3", "worse than 0.2",
        "better than 0.5", "near 1 -2.5 0 0.25", "verdict depth_spent", "edge 3 17 and refused",
        "tet 10391 for good", "level 2 and operator smoothing and worse than 0.3 for good"}) {
    CHECK(to_text(parse_condition(text)) == text);
  }
}

TEST_CASE("a condition that makes no sense is an error that says what is valid") {
  for (const char* text :
       {"", "sometimes", "deeper", "deeper x", "deeper -1", "edge 3", "edge 3 4 5", "operator",
        "tet 99999999999", "and", "refused and", "and refused", "refused accepted", "for good",
        "worse 0.2", "worse than x", "near 1 2 3"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(parse_condition(text), doctest::Contains("edge A B"), Error);
  }
}

TEST_CASE("a condition about calls holds where they begin or end") {
  const test::HandmadeTrace trace;
  const TraceFile file(trace.path());
  CHECK(stop(file, "refused", 0) == 6);
  CHECK(stop(file, "refused", 6) == 8);
  CHECK(stop(file, "refused", 9) == std::nullopt);
  CHECK(stop(file, "refused", 9, kBack) == 8);
  CHECK(stop(file, "accepted", 0) == std::nullopt);
  CHECK(stop(file, "deeper 0", 0) == 7);
  CHECK(stop(file, "deeper 1", 0) == std::nullopt);
  CHECK(stop(file, "operator shell_transformation", 0) == 4);
  CHECK(stop(file, "edge 1 0", 3) == 4);
  CHECK(stop(file, "edge 2 0", 0) == 7);
  CHECK(stop(file, "edge 0 1", 7, kBack) == 4);
  CHECK(stop(file, "face 0 1 2", 0) == std::nullopt);
  CHECK(stop(file, "vertex 2", 0) == 7);
}

TEST_CASE("a run finds accepted calls at their end, and faces only where a face is the target") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  std::vector<std::uint64_t> accepted;
  const Call* face = nullptr;
  for (const Call& call : file.calls()) {
    if (call.accepted()) accepted.push_back(call.events.end);
    if (face == nullptr && call.target_size == 3) face = &call;
  }
  std::sort(accepted.begin(), accepted.end());
  REQUIRE(accepted.size() > 2);
  CHECK(stop(file, "accepted", 0) == accepted[0]);
  CHECK(stop(file, "accepted", accepted[0]) == accepted[1]);
  CHECK(stop(file, "accepted", accepted[1], kBack) == accepted[0]);
  CHECK(stop(file, "accepted", accepted[0], kBack) == std::nullopt);

  REQUIRE(face != nullptr);
  const std::uint64_t begin = face->events.begin;
  const auto v = face->target();
  CHECK(stop(file, fmt::format("face {} {} {}", v[2].index(), v[0].index(), v[1].index()), begin) ==
        begin + 1);
  CHECK(stop(file, fmt::format("edge {} {}", v[0].index(), v[1].index()), begin) != begin + 1);
}

TEST_CASE("a call that was cut off is neither accepted nor refused") {
  const test::TempFolder folder;
  const TetMesh mesh(test::shell_mesh({.degree = 5}));
  {
    TraceRecorder recorder(folder / "cut.trace", mesh, {});
    const std::array edge = {VertexHandle(0), VertexHandle(1)};
    recorder.attempt_begins({"shell_transformation", edge, 0, ""});
    recorder.finish();
  }
  test::cut_end(folder / "cut.trace");
  const TraceFile file(folder / "cut.trace");
  REQUIRE(file.calls().size() == 1);
  CHECK(stop(file, "edge 0 1", 0) == 1);
  CHECK(stop(file, "refused", 0) == std::nullopt);
  CHECK(stop(file, "accepted", 0) == std::nullopt);
}

TEST_CASE("a tet and a vertex are found where an edit changes them, forwards and backwards") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  EventCursor cursor(file);
  std::vector<std::uint64_t> tet_stops;
  std::vector<std::uint64_t> moves;
  const TetHandle tet(7);
  VertexHandle vertex;
  while (cursor.position() < file.event_count()) {
    const TraceEvent& event = cursor.next();
    const auto has = [&](const auto& tets) {
      return std::find(tets.begin(), tets.end(), tet) != tets.end();
    };
    if (event.kind == EventKind::replace_cavity && (has(event.removed) || has(event.created))) {
      tet_stops.push_back(cursor.position());
    }
    if (event.kind == EventKind::move_vertex) {
      if (has(event.removed)) tet_stops.push_back(cursor.position());
      if (!vertex.is_valid()) vertex = event.vertices.front();
      if (event.vertices.front() == vertex) moves.push_back(cursor.position());
    }
  }
  REQUIRE(tet_stops.size() > 2);
  REQUIRE(moves.size() > 0);
  std::uint64_t from = 0;
  for (const std::uint64_t expected : tet_stops) {
    from = stop(file, "tet 7", from).value();
    CHECK(from == expected);
  }
  CHECK(stop(file, "tet 7", from) == std::nullopt);
  CHECK(stop(file, "tet 7", from, kBack) == tet_stops[tet_stops.size() - 2]);
  CHECK(stop(file, "tet 7", tet_stops.front(), kBack) == std::nullopt);
  const std::string name = "vertex " + std::to_string(vertex.index());
  CHECK(stop(file, name, moves.front() - 1) == moves.front());
}

TEST_CASE("an unknown verdict is told with those that there are") {
  CHECK_THROWS_WITH_AS(parse_condition("verdict maybe"), doctest::Contains("no_improvement"),
                       Error);
}

TEST_CASE("terms hold together of one call") {
  const test::HandmadeTrace trace;
  const TraceFile file(trace.path());
  CHECK(stop(file, "edge 0 1 and refused", 0) == 6);
  CHECK(stop(file, "edge 0 1 and refused", 6) == 9);
  CHECK(stop(file, "edge 0 1 and refused", 10, kBack) == 9);
  CHECK(stop(file, "edge 0 1 and accepted", 0) == std::nullopt);
  CHECK(stop(file, "level 1 and verdict depth_spent", 0) == 8);
  CHECK(stop(file, "level 0 and verdict depth_spent", 0) == std::nullopt);
  CHECK(stop(file, "operator shell_transformation and edge 0 1", 0) == 4);
  CHECK(stop(file, "worse than 0.3 and edge 0 2", 0) == 7);  // the visited tet has 0.25
  CHECK(stop(file, "worse than 0.2", 0) == std::nullopt);
  CHECK(stop(file, "better than 0.2", 0) == 3);
}

namespace {

/// All places of a condition, by looking at each call and edit.
std::vector<std::uint64_t> places(const TraceFile& file, const std::string& text) {
  std::vector<std::uint64_t> all;
  Replay replay(file);
  const Condition condition = parse_condition(text);
  for (auto at = find_stop({file, replay}, condition, 0, kForward); at;
       at = find_stop({file, replay}, condition, *at, kForward)) {
    all.push_back(*at);
  }
  return all;
}

}  // namespace

TEST_CASE("a search back finds the same places as one forwards") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  for (const char* text : {"accepted", "refused and level 1", "worse than 0.3 and accepted",
                           "near 0 0 0 0.4 and accepted", "vertex 30 for good", "tet 12"}) {
    CAPTURE(text);
    const auto forwards = places(file, text);
    CHECK_FALSE(forwards.empty());
    std::vector<std::uint64_t> back;
    const Condition condition = parse_condition(text);
    for (auto at = find_stop({file, replay}, condition, file.event_count() + 1, kBack); at;
         at = find_stop({file, replay}, condition, *at, kBack)) {
      back.insert(back.begin(), *at);
    }
    CHECK(forwards == back);
  }
}

TEST_CASE("every accepted call near a place is found") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  std::vector<std::uint64_t> truth;
  for (const Call& call : file.calls()) {
    if (!call.accepted()) continue;
    replay.seek(call.events.begin);
    const auto target = call.target();
    const bool is_near = std::any_of(target.begin(), target.end(), [&](VertexHandle v) {
      return !replay.mesh().is_deleted(v) && replay.mesh().point(v).norm() <= 0.4;
    });
    if (is_near) truth.push_back(call.events.end);
  }
  std::sort(truth.begin(), truth.end());
  truth.erase(std::unique(truth.begin(), truth.end()), truth.end());
  CHECK(places(file, "near 0 0 0 0.4 and accepted") == truth);
}

TEST_CASE("accepted for good are the calls that no caller undid, and undone are the others") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  std::vector<std::uint64_t> lasting;
  std::vector<std::uint64_t> undone;
  for (const Call& call : file.calls()) {
    if (call.accepted()) (call.undone ? undone : lasting).push_back(call.events.end);
  }
  REQUIRE(!lasting.empty());
  REQUIRE(!undone.empty());
  std::sort(lasting.begin(), lasting.end());
  std::sort(undone.begin(), undone.end());
  CHECK(places(file, "accepted for good") == lasting);
  CHECK(places(file, "undone") == undone);
  CHECK(places(file, "accepted").size() == lasting.size() + undone.size());
  CHECK(places(file, "undone for good").empty());
}

TEST_CASE("all calls of a condition are listed, the nearest to being accepted first") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  const Condition condition = parse_condition("operator smoothing and refused");
  const auto found = find_all({file, replay}, condition);
  std::size_t truth = 0;
  for (const Call& call : file.calls()) {
    const bool is_refused = call.verdict && !call.accepted();
    truth += is_refused && call.algorithm == Algorithm::smoothing ? 1 : 0;
  }
  REQUIRE(truth > 10);
  CHECK(found.size() == truth);
  for (std::size_t i = 1; i < found.size(); ++i) {
    CHECK(file.calls()[found[i - 1]].missing() <= file.calls()[found[i]].missing());
  }
  CHECK_THROWS_WITH_AS(find_all({file, replay}, parse_condition("tet 12")),
                       doctest::Contains("about edits"), Error);
}

TEST_CASE("for good leaves out what was undone") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  const auto all = places(file, "tet 12");
  const auto lasting = places(file, "tet 12 for good");
  CHECK(lasting.size() < all.size());
  CHECK(std::includes(all.begin(), all.end(), lasting.begin(), lasting.end()));
  // What lasts: the content of the slot after it stays until the next place.
  Replay replay(file);
  for (std::size_t i = 0; i < lasting.size(); ++i) {
    replay.seek(lasting[i]);
    const bool was_there = !replay.mesh().is_deleted(TetHandle(12));
    const TetVertices made = was_there ? replay.mesh().vertices(TetHandle(12)) : TetVertices();
    replay.seek(i + 1 < lasting.size() ? lasting[i + 1] - 1 : file.event_count());
    const bool is_there = !replay.mesh().is_deleted(TetHandle(12));
    CHECK(is_there == was_there);
    if (is_there) CHECK(replay.mesh().vertices(TetHandle(12)) == made);
  }
}
