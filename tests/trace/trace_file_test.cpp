// SPDX-License-Identifier: MIT
#include "trace/trace_file.h"

#include <algorithm>
#include <map>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/traced_run.h"
#include "trace/call_tree.h"
#include "trace/replay.h"
#include "trace/text_trace.h"
#include "trace/trace_summary.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// What TextTrace would have written, from the file.
std::string as_text(const TraceFile& file) {
  TextTrace text;
  EventCursor cursor(file);
  for (std::uint64_t k = 0; k < file.event_count(); ++k) {
    const TraceEvent& event = cursor.next();
    if (event.kind == EventKind::attempt_begins) {
      text.attempt_begins({file.name(event.name), event.vertices, event.number});
    } else if (event.kind == EventKind::attempt_ends) {
      text.attempt_ends(event.verdict, event.before, event.after);
    }
  }
  return text.text();
}

const std::string kBrief = "local_reconnection{} smooth{} insert_points{}";

}  // namespace

TEST_CASE("a trace file holds every call of a run with its target, verdict and vectors") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("sheet.mesh");
  TetMesh again = mesh;
  const Schedule schedule("brief", kBrief);
  record(mesh, folder / "trace", {}, {}, schedule);
  TextTrace text;
  Registry registry = Registry::builtin();
  Run run(again, registry);
  run.set_trace(&text);
  improve(run, schedule);
  const TraceFile file(folder / "trace");
  CHECK(as_text(file) == text.text());
  CHECK(file.damage().empty());
  CHECK(file.header().schedule_text == kBrief);
  REQUIRE(file.passes().size() == run.records.size());
  for (std::size_t p = 0; p < run.records.size(); ++p) {
    CHECK(file.name(file.passes()[p].name) == run.records[p].name);
    CHECK(file.passes()[p].now.n_bad == run.records[p].after.n_bad);
  }
  const TraceSummary summary = summarize(file);
  std::size_t attempts = 0;
  for (const PassRecord& record : run.records) attempts += record.attempts();
  CHECK(summary.outermost_calls == attempts);
}

TEST_CASE("calls, visits and passes of a trace lie inside each other") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("sheet.mesh");
  record(mesh, folder / "trace");
  const TraceFile file(folder / "trace");
  const std::span<const Call> calls = file.calls();
  REQUIRE(calls.size() > 1000);
  std::size_t wrong = 0;
  for (std::uint32_t c = 0; c < calls.size(); ++c) {
    const Call& call = calls[c];
    if (call.subtree_end <= c || call.events.end <= call.events.begin) ++wrong;
    if (file.call_at(call.events.begin) != c || file.call_at(call.events.end - 1) != c) ++wrong;
    if (call.parent == kNoCall) continue;
    const Call& parent = calls[call.parent];
    if (parent.events.begin >= call.events.begin || parent.events.end <= call.events.end) ++wrong;
    if (parent.subtree_end < call.subtree_end || parent.depth + 1 != call.depth) ++wrong;
    if (parent.events.begin_seconds > call.events.begin_seconds ||
        parent.events.end_seconds < call.events.end_seconds) {
      ++wrong;
    }
  }
  for (const Visit& visit : file.visits()) {
    if (visit.first_call >= visit.last_call) ++wrong;  // others are not written
    if (calls[visit.first_call].events.begin < visit.events.begin) ++wrong;
    if (calls[visit.last_call - 1].events.end > visit.events.end) ++wrong;
  }
  CHECK(wrong == 0);
}

TEST_CASE("a trace that was cut off anywhere opens up to there, with a message") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("folded_sheet.mesh");
  record(mesh, folder / "trace");
  const std::string whole = read_text(folder / "trace");
  const std::uint64_t events = TraceFile(folder / "trace").event_count();
  std::uint64_t last = 0;
  for (std::size_t size = whole.size() / 2; size < whole.size(); size += whole.size() / 40) {
    CAPTURE(size);
    write_text(folder / "cut", whole.substr(0, size));
    const TraceFile cut(folder / "cut");
    CHECK(cut.damage().find(fmt::format("read up to event {}", cut.event_count())) !=
          std::string::npos);
    CHECK(cut.event_count() <= events);
    CHECK(cut.event_count() >= last);
    last = cut.event_count();
    Replay(cut).seek(cut.event_count());
  }
  CHECK(last > 0);
}

TEST_CASE("a trace with a wrong byte opens up to there, or not at all, with a message") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("sheet.mesh");
  record(mesh, folder / "trace");
  const std::string whole = read_text(folder / "trace");
  const std::string calls = as_text(TraceFile(folder / "trace"));
  std::size_t opened = 0;
  std::size_t harmless = 0;
  for (const std::uint64_t at : random_numbers(100, whole.size())) {
    CAPTURE(at);
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    write_text(folder / "damaged", damaged);
    try {
      const TraceFile file(folder / "damaged");
      ++opened;
      Replay replay(file);
      replay.seek(file.event_count());
      if (!file.damage().empty()) continue;
      // A frame has bits without meaning.
      ++harmless;
      CHECK(as_text(file) == calls);
      CHECK(replay.mesh().fingerprint() == SlotMesh(mesh).fingerprint());
    } catch (const Error& error) {
      CHECK(std::string(error.what()).find("damaged") != std::string::npos);
    }
  }
  CHECK(opened > 10);
  CHECK(harmless < 5);
}

TEST_CASE("what is no trace, or one of another version, is refused with the reason") {
  const TempFolder folder;
  write_text(folder / "text", "MeshVersionFormatted 2\n");
  CHECK_THROWS_WITH_AS(TraceFile(folder / "text"), doctest::Contains("is no trace of tetmend"),
                       Error);
  CHECK_THROWS_WITH_AS(TraceFile(folder / "none"), doctest::Contains("No such file"), Error);
  TetMesh mesh = TetMesh(two_tets());
  record(mesh, folder / "trace");
  std::string other = read_text(folder / "trace");
  other[8] = 99;
  write_text(folder / "other", other);
  CHECK_THROWS_WITH_AS(TraceFile(folder / "other"), doctest::Contains("version 99"), Error);
}

TEST_CASE("the tree of a call shows its calls, indented, and why they were refused") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("sheet.mesh");
  record(mesh, folder / "trace", {}, {}, Schedule("brief", kBrief));
  const TraceFile file(folder / "trace");
  std::uint32_t root = 0;
  while (file.calls()[root].subtree_end - root < 3) root = file.calls()[root].subtree_end;
  const std::string text = call_tree_text(file, root);
  const std::uint32_t calls = file.calls()[root].subtree_end - root;
  CHECK(static_cast<std::uint32_t>(std::ranges::count(text, '\n')) == calls);
  CHECK(text.find(fmt::format("{:>9}  {} -> ", root, describe_call(file, root))) == 0);
  CHECK(text.find(fmt::format("{:>9}    {} -> ", root + 1, describe_call(file, root + 1))) !=
        std::string::npos);
  const std::string dot = call_tree_dot(file, root);
  CHECK(dot.starts_with("digraph calls {\n"));
  CHECK(dot.find(fmt::format("c{} -> c{};", root, root + 1)) != std::string::npos);
}

TEST_CASE(
    "a refusal by comparison has the vectors of what was tried, a refusal without a candidate "
    "none") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("folded_sheet.mesh");
  // A polish has a judge of the mean.
  record(mesh, folder / "trace", {}, {},
         Schedule("plain", "run_schedule('shell', {polish_first = 0, polish_last = 0})"));
  const TraceFile file(folder / "trace");
  EventCursor cursor(file);
  std::size_t compared = 0;
  for (std::uint32_t k = 0; k < file.calls().size(); ++k) {
    const Call& call = file.calls()[k];
    if (call.accepted()) continue;
    cursor.move_to(call.events.end - 1);
    const TraceEvent& event = cursor.next();
    CHECK(event.before.empty() == event.after.empty());
    const bool by_comparison = call.candidate_found && file.reason(call).starts_with("the quality");
    if (!by_comparison) {
      const bool from_below = call.subtree_end > k + 1;  // of the whole recursion
      CHECK((event.before.empty() || (from_below && call.candidate_found)));
      continue;
    }
    if (event.before.empty()) continue;  // apply() itself found nothing better
    ++compared;
    CHECK(std::ranges::is_sorted(event.before));
    CHECK(std::ranges::is_sorted(event.after));
    // A fair judge may refuse a better vector, a strict one never does.
    if (file.name(call.operator_name) == "edge_removal")
      CHECK_FALSE(improves(event.after, event.before));
    CHECK(call.worst_before == event.before.front());
    CHECK(call.worst_after == event.after.front());
  }
  CHECK(compared > 10);
}

TEST_CASE("the reason of a refusal tells a search without result from one whose result is no use") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("folded_sheet.mesh");
  record(mesh, folder / "trace");
  const TraceFile file(folder / "trace");
  std::map<std::string_view, std::size_t> reasons;
  std::size_t wrong = 0;
  for (std::uint32_t c = 0; c < file.calls().size(); ++c) {
    const Call& call = file.calls()[c];
    const std::string_view reason = file.reason(call);
    ++reasons[reason];
    if (reason.empty()) ++wrong;
    const bool calls_others = call.subtree_end > c + 1;
    if (calls_others && reason.find("candidate") != std::string_view::npos) ++wrong;
  }
  CHECK(wrong == 0);
  for (const std::string_view reason :
       {"the quality vector of all that changed is better", "what the call was for is done",
        "no candidate is better than what is there",
        "the quality vector with the candidate is not better",
        "what the calls in it reached is not enough",
        "the target lies on the boundary or on a constraint",
        "nothing helped up to the deepest level allowed"}) {
    CHECK_MESSAGE(reasons[reason] > 0, reason);
  }
}
