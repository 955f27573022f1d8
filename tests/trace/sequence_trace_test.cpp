// SPDX-License-Identifier: MIT
// A sequence in a trace: a call with its parts in it, kept or undone as a whole.
#include <algorithm>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/traced_run.h"
#include "trace/call_tree.h"
#include "trace/replay.h"
#include "trace/trace_file.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const Schedule kSequences("sequences", R"(
    apply(sequence{"edge_split", "shell_transformation", {"smoothing", steps = 5}}))");

struct RecordedSequences {
  TempFolder folder;
  TetMesh before = TetMesh(delaunay_ball(80, 4));
  TetMesh mesh = before;
  std::map<std::uint64_t, std::uint64_t> truth;  // by event: all of them

  explicit RecordedSequences(const TraceFilter& filter = {}) {
    record(mesh, folder / "trace", filter, {}, kSequences);
    std::set<std::uint64_t> all;
    const std::uint64_t events = TraceFile(folder / "trace").event_count();
    for (std::uint64_t k = 0; k <= events; ++k) all.insert(k);
    mesh = before;
    truth = record(mesh, folder / "trace", filter, all, kSequences);
  }
};

/// A sequence that ended so, some of whose parts were accepted.
std::optional<std::uint32_t> find_sequence(const TraceFile& file, Verdict verdict) {
  for (std::uint32_t c = 0; c < file.calls().size(); ++c) {
    const Call& call = file.calls()[c];
    if (file.name(call.operator_name) != kSequenceName || call.verdict != verdict) continue;
    const auto parts = file.calls().subspan(c + 1, call.subtree_end - c - 1);
    if (std::ranges::count_if(parts, &Call::accepted) > 1) return c;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("a sequence is a call with its parts in it, its verdict and its quality vectors") {
  const RecordedSequences recorded;
  const TraceFile file(recorded.folder / "trace");
  CHECK(file.damage().empty());
  std::size_t wrong = 0;
  for (const Call& call : file.calls()) {
    const bool is_sequence = file.name(call.operator_name) == kSequenceName;
    if (is_sequence != (call.depth == 0) || (is_sequence && call.edits > 0)) ++wrong;
  }
  CHECK(wrong == 0);
  const auto kept = find_sequence(file, Verdict::accepted);
  REQUIRE(kept);
  const Call& call = file.calls()[*kept];
  const Call& opening = file.calls()[*kept + 1];
  CHECK(file.name(opening.operator_name) == "edge_split");
  CHECK(opening.parent == *kept);
  CHECK(std::ranges::equal(opening.target(), call.target()));
  CHECK(file.name(call.settings).starts_with("{\"edge_split\", least_gain = "));
  CHECK(file.name(call.settings).ends_with("desperate = 0.4, theta_max = 180"));
  CHECK(call.candidate_found);
  CHECK(call.worst_before > 0);
  CHECK(call.worst_after >= call.worst_before);
  const auto undone = find_sequence(file, Verdict::no_improvement);
  REQUIRE(undone);
  CHECK(file.calls()[*undone].worst_before > 0);
  CHECK(file.reason(file.calls()[*undone]) == "what the calls in it reached is not enough");
  // One whose opening was refused has compared nothing itself.
  for (const Call& c : file.calls()) {
    if (c.depth > 0 || c.candidate_found) continue;
    CHECK_FALSE(c.accepted());
    CHECK(c.worst_before == 0);
  }
}

TEST_CASE("replay steps through a sequence that is kept and through one that is undone") {
  const RecordedSequences recorded;
  const TraceFile file(recorded.folder / "trace");
  Replay replay(file);
  const auto print_at = [&](std::uint64_t position) {
    replay.seek(position);
    return replay.mesh().fingerprint();
  };
  std::size_t wrong = 0;
  for (const auto& [k, print] : recorded.truth) wrong += print_at(k) != print ? 1 : 0;
  for (auto at = recorded.truth.rbegin(); at != recorded.truth.rend(); ++at) {
    wrong += print_at(at->first) != at->second ? 1 : 0;
  }
  REQUIRE(recorded.truth.size() == file.event_count() + 1);
  CHECK(wrong == 0);
  CHECK(print_at(file.event_count()) == SlotMesh(recorded.mesh).fingerprint());

  const auto kept = find_sequence(file, Verdict::accepted);
  const auto undone = find_sequence(file, Verdict::no_improvement);
  REQUIRE(kept);
  REQUIRE(undone);
  const EventRange& stays = file.calls()[*kept].events;
  CHECK(print_at(stays.begin) != print_at(stays.end));
  const EventRange& goes = file.calls()[*undone].events;
  CHECK(print_at(goes.begin) == print_at(goes.end));
  // In between its parts were there.
  const EventRange& opening = file.calls()[*undone + 1].events;
  CHECK(print_at(opening.end) != print_at(goes.end));
}

TEST_CASE("what filters leave of sequences leads to the same mesh") {
  const std::vector<TraceFilter> filters = {
      {.operators = {"smoothing"}}, {.operators = {"edge_split"}}, {.depth = 0}};
  for (const TraceFilter& filter : filters) {
    CAPTURE(filter.describe());
    const RecordedSequences recorded(filter);
    const TraceFile file(recorded.folder / "trace");
    REQUIRE(!file.calls().empty());
    Replay replay(file);
    replay.seek(file.event_count());
    CHECK(replay.mesh().fingerprint() == SlotMesh(recorded.mesh).fingerprint());
  }
}

TEST_CASE("no chunk of a trace begins inside a sequence") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("folded_sheet.mesh");
  record(mesh, folder / "trace", {}, {}, Schedule("sequences", R"(
    apply(sequence{"edge_split", "shell_transformation", "smoothing"}, {on = {worst = 300}}))"));
  const TraceFile file(folder / "trace");
  REQUIRE(file.chunk_begins().size() > 1);
  for (const std::uint64_t begin : file.chunk_begins()) {
    const std::uint32_t call = file.call_at(begin);
    CHECK((call == kNoCall || file.calls()[call].events.begin == begin));
  }
  Replay replay(file, Replay::kDefaultMemory, 1);
  replay.seek(file.event_count());
  CHECK(replay.mesh().fingerprint() == SlotMesh(mesh).fingerprint());
}
