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
  return find_stop(file, parse_condition(text), from, direction);
}

}  // namespace

TEST_CASE("a condition is written as it is read") {
  for (const char* text : {"accepted", "refused", "deeper 2", "operator edge_removal", "edge 3 17",
                           "face 1 2 3", "vertex 5", "tet 4711"}) {
    CHECK(to_text(parse_condition(text)) == text);
  }
}

TEST_CASE("a condition that makes no sense is an error that says what is valid") {
  for (const char* text : {"", "sometimes", "deeper", "deeper x", "deeper -1", "edge 3",
                           "edge 3 4 5", "operator", "tet 99999999999"}) {
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
