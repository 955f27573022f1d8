// SPDX-License-Identifier: MIT
#include "trace/recorder.h"

#include <algorithm>
#include <array>
#include <string>

#include <doctest/doctest.h>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"
#include "tests/support/threads.h"
#include "tests/support/traced_run.h"
#include "trace/replay.h"
#include "trace/trace_file.h"
#include "trace/trace_summary.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// The replay of the whole trace ends with the mesh that the run left.
bool ends_with(const TraceFile& file, const TetMesh& mesh) {
  Replay replay(file);
  replay.seek(file.event_count());
  return replay.mesh().fingerprint() == SlotMesh(mesh).fingerprint();
}

bool is_inside(const Call& call, const TraceFile& file, std::string_view operator_name) {
  for (const Call* c = &call;; c = &file.calls()[c->parent]) {
    if (file.name(c->operator_name) == operator_name) return true;
    if (c->parent == kNoCall) return false;
  }
}

}  // namespace

TEST_CASE("a mesh is the same with and without a recorder") {
  const TempFolder folder;
  TetMesh plain = asset_mesh("sheet.mesh");
  TetMesh traced = plain;
  Registry registry = Registry::builtin();
  Run run(plain, registry);
  improve(run);
  record(traced, folder / "trace");
  CHECK(plain == traced);
}

TEST_CASE(
    "a mesh that is divided among threads has the same trace and the same end on any number") {
  const TempFolder folder;
  TetMesh last = asset_mesh("folded_sheet.mesh");
  const auto run_divided = [&](int threads, TraceRecorder* recorder) {
    Registry registry = Registry::builtin();
    on_threads(threads, [&] {
      Run run(last, registry);
      run.set_block_count(8);
      run.set_trace(recorder);
      improve(run, Schedule::builtin("shell"));
    });
  };
  const auto trace_on = [&](int threads) {
    last = asset_mesh("folded_sheet.mesh");
    TraceRecorder recorder(folder / "trace", last, {}, {}, TraceClock::steps);
    run_divided(threads, &recorder);
    recorder.finish();
    return read_text(folder / "trace");
  };
  const std::string alone = trace_on(1);
  CHECK(trace_on(3) == alone);
  const TetMesh traced = last;
  last = asset_mesh("folded_sheet.mesh");
  run_divided(3, nullptr);
  CHECK(last == traced);
  const TraceFile file(folder / "trace");
  CHECK(ends_with(file, traced));
  CHECK(std::ranges::any_of(file.calls(),
                            [](const Call& call) { return call.verdict == Verdict::deferred; }));
}

TEST_CASE("equal runs give equal files when steps are the clock") {
  const TempFolder folder;
  const auto bytes = [&](TraceClock clock) {
    TetMesh mesh = asset_mesh("sheet.mesh");
    record(mesh, folder / "trace", {}, {}, Schedule("brief", "local_reconnection{}"), clock);
    return read_text(folder / "trace");
  };
  CHECK(bytes(TraceClock::steps) == bytes(TraceClock::steps));
  CHECK(bytes(TraceClock::real) != bytes(TraceClock::real));
  bytes(TraceClock::steps);
  const TraceFile file(folder / "trace");
  CHECK(file.calls()[1].events.begin_seconds > file.calls()[0].events.begin_seconds);
}

TEST_CASE("a filter by operator keeps its calls with all in them, and the way of the mesh") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("sheet.mesh");
  TetMesh again = mesh;
  record(mesh, folder / "all");
  const TraceFile all(folder / "all");
  for (const std::string name : {"smoothing", "shell_transformation"}) {
    CAPTURE(name);
    TetMesh filtered = again;
    record(filtered, folder / "some", {.operators = {name}});
    const TraceFile some(folder / "some");
    const auto wanted = std::ranges::count_if(
        all.calls(), [&](const Call& call) { return is_inside(call, all, name); });
    CHECK(wanted > 0);
    CHECK(some.calls().size() == static_cast<std::size_t>(wanted));
    CHECK(some.event_count() < all.event_count());
    CHECK(ends_with(some, mesh));
  }
}

TEST_CASE("a filter by depth keeps the outer calls, and the way of the mesh") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("sheet.mesh");
  TetMesh again = mesh;
  record(mesh, folder / "all");
  const TraceFile all(folder / "all");
  for (const unsigned depth : {0u, 2u}) {
    TetMesh filtered = again;
    record(filtered, folder / "some", {.depth = depth});
    const TraceFile some(folder / "some");
    const auto wanted =
        std::ranges::count_if(all.calls(), [&](const Call& call) { return call.depth <= depth; });
    CHECK(some.calls().size() == static_cast<std::size_t>(wanted));
    CHECK(some.calls().size() < all.calls().size());
    CHECK(ends_with(some, mesh));
  }
}

TEST_CASE("a filter by place keeps the calls that aim at it, with all in them") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("sheet.mesh");
  const TetMesh before = mesh;
  record(mesh, folder / "all");
  const TraceFile all(folder / "all");
  const VertexHandle centre = all.calls()[0].target_vertices[0];
  const TraceFilter::Ball ball{before.point(centre), 1e-9};
  TetMesh filtered = before;
  record(filtered, folder / "some", {.around = ball});
  const TraceFile some(folder / "some");
  CHECK(!some.calls().empty());
  CHECK(some.calls().size() < all.calls().size());
  for (const Call& call : some.calls()) {
    if (call.depth == 0) CHECK(std::ranges::count(call.target(), centre) == 1);
  }
  CHECK(ends_with(some, mesh));
}

TEST_CASE("a trace with a limit ends before it, and the run goes on") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("folded_sheet.mesh");
  TetMesh limited = mesh;
  record(mesh, folder / "all");
  const std::uintmax_t size = std::filesystem::file_size(folder / "all");
  record(limited, folder / "some", {.most_bytes = size / 2 + size / 3});
  CHECK(std::filesystem::file_size(folder / "some") <= size / 2 + size / 3);
  CHECK(mesh == limited);
  const TraceFile some(folder / "some");
  CHECK(some.limit_reached());
  CHECK(some.damage().empty());
  CHECK(some.event_count() > 0);
  CHECK(some.event_count() < TraceFile(folder / "all").event_count());
}

TEST_CASE("a trace that is not finished leaves nothing") {
  const TempFolder folder;
  const TetMesh mesh = asset_mesh("sheet.mesh");
  write_text(folder / "trace", "older");
  {
    const TraceRecorder recorder(folder / "trace", mesh, {});
    CHECK(std::filesystem::exists(folder / "trace.part"));
  }
  CHECK(folder.entries() == 1);
  CHECK(read_text(folder / "trace") == "older");
}

TEST_CASE("a trace follows no link at the name of its part, and takes no file away") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("sheet.mesh");
  write_text(folder / "dear", "dear to me");
  std::filesystem::create_symlink(folder / "dear", folder / "trace.part");
  record(mesh, folder / "trace");
  CHECK(read_text(folder / "dear") == "dear to me");
  CHECK(std::filesystem::is_symlink(folder / "trace.part"));
  CHECK(!std::filesystem::is_symlink(folder / "trace"));
  CHECK(TraceFile(folder / "trace").damage().empty());
  CHECK(folder.entries() == 3);
}

TEST_CASE("a trace without its end, as a crash leaves it, can be read") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("sheet.mesh");
  record(mesh, folder / "trace");
  cut_end(folder / "trace");
  const TraceFile file(folder / "trace");
  CHECK(file.damage().find("has no end") != std::string::npos);
  CHECK(ends_with(file, mesh));
}

TEST_CASE("a trace that cannot be written is an error with the reason") {
  const TempFolder folder;
  const TetMesh mesh = asset_mesh("sheet.mesh");
  CHECK_THROWS_WITH_AS(TraceRecorder(folder / "no" / "trace", mesh, {}),
                       doctest::Contains("No such file or directory"), Error);
}

TEST_CASE("a trace in memory is looked at in the middle of an attempt, and goes on") {
  const TetMesh mesh(shell_mesh({.degree = 5}));
  std::string memory;
  TraceRecorder recorder(memory, mesh, {});
  const std::array edge = {VertexHandle(0), VertexHandle(1)};
  recorder.pass_begins("reconnect", 1);
  recorder.attempt_begins({"edge_removal", edge, 0, "max_degree = 7"});
  recorder.candidate_found();
  const TraceFile half("half", recorder.so_far());
  CHECK(half.damage() == "");
  CHECK(half.event_count() == 3);
  REQUIRE(half.calls().size() == 1);
  CHECK_FALSE(half.calls()[0].verdict);
  CHECK(half.calls()[0].candidate_found);
  recorder.attempt_ends(Verdict::no_improvement, {}, {});
  recorder.pass_ends({});
  const std::string looked_at = recorder.so_far();
  recorder.finish();
  CHECK(memory == looked_at);
  const TraceFile whole("whole", memory);
  CHECK(whole.event_count() == 5);
  CHECK(whole.calls()[0].verdict == Verdict::no_improvement);
  CHECK(Replay(whole).mesh().fingerprint() == SlotMesh(mesh).fingerprint());
}

TEST_CASE("a trace says which parameters a user has changed, between which passes") {
  const TetMesh mesh(shell_mesh({.degree = 5}));
  std::string memory;
  TraceRecorder recorder(memory, mesh, {});
  recorder.pass_begins("smooth", 1);
  recorder.pass_ends({});
  recorder.parameter_changed("smoothing: rings = 2");
  recorder.pass_begins("smooth", 2);
  recorder.pass_ends({});
  recorder.finish();
  const TraceFile file("changed", memory);
  REQUIRE(file.parameter_changes().size() == 1);
  CHECK(file.parameter_changes()[0].event == 2);
  CHECK(file.name(file.parameter_changes()[0].text) == "smoothing: rings = 2");
  CHECK(contains(format_summary(file, summarize(file)),
                 "changed while the run was paused: smoothing: rings = 2\nsmooth"));
}

TEST_CASE("events in memory without their mesh are played on the mesh that they begin with") {
  const TetMesh start = asset_mesh("sheet.mesh");
  std::string whole, events;
  const auto record_into = [&](std::string& memory, TraceBeginning beginning) {
    TetMesh mesh = start;
    TraceRecorder recorder(memory, mesh, {}, TraceClock::steps, beginning);
    const Registry registry = Registry::builtin();
    Run run(mesh, registry);
    run.set_trace(&recorder);
    improve(run, Schedule("brief", "local_reconnection{} smooth{}"));
    run.set_trace(nullptr);
    recorder.finish();
  };
  record_into(whole, TraceBeginning::with_mesh);
  record_into(events, TraceBeginning::without_mesh);
  CHECK(events.size() < whole.size());
  const TraceFile wanted("whole", whole);
  const TraceFile file("events", events, SlotMesh(start));
  REQUIRE(file.event_count() == wanted.event_count());
  CHECK(file.damage().empty());
  CHECK(file.calls().size() == wanted.calls().size());
  Replay replay(file), other(wanted);
  for (const std::uint64_t position :
       {file.event_count(), file.event_count() / 2, std::uint64_t{0}}) {
    replay.seek(position);
    other.seek(position);
    CHECK(replay.mesh().fingerprint() == other.mesh().fingerprint());
    CHECK(replay.cavity().created.size() == other.cavity().created.size());
  }
  CHECK_THROWS_AS(TraceFile("events", events), Error);
}
