// SPDX-License-Identifier: MIT
// What became of accepted calls, and the ledger of a whole run.
#include "trace/ledger.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "kernel/transaction.h"
#include "kernel/workspace.h"
#include "tests/support/example_traces.h"
#include "trace/replay.h"

using namespace tetmend;

namespace {

/// What became of the edits of a trace, told by the meshes that a replay has: an undo is of the edit
/// before which the mesh was as it is after the undo.
struct Fate {
  explicit Fate(const TraceFile& file) {
    Replay replay(file, 0);
    EventCursor cursor(file);
    struct Edit {
      std::uint64_t event, before;
    };
    std::vector<Edit> standing;
    for (std::uint64_t k = 0; k < file.event_count(); ++k) {
      const EventKind kind = cursor.next().kind;
      if (!changes_mesh(kind)) continue;
      if (kind != EventKind::undo) {
        replay.seek(k);
        standing.push_back({k, replay.mesh().fingerprint()});
        continue;
      }
      replay.seek(k + 1);
      REQUIRE(!standing.empty());
      REQUIRE(replay.mesh().fingerprint() == standing.back().before);
      undone[standing.back().event] = k;
      standing.pop_back();
    }
    for (const Edit& edit : standing) lasting.insert(edit.event);
  }

  /// Edits within the call that stood when it ended.
  std::vector<std::uint64_t> edits_of(const Call& call) const {
    std::vector<std::uint64_t> edits;
    for (auto e = lasting.lower_bound(call.events.begin);
         e != lasting.end() && *e < call.events.end; ++e) {
      edits.push_back(*e);
    }
    for (auto e = undone.lower_bound(call.events.begin);
         e != undone.end() && e->first < call.events.end; ++e) {
      if (e->second >= call.events.end) edits.push_back(e->first);
    }
    return edits;
  }

  std::set<std::uint64_t> lasting;
  std::map<std::uint64_t, std::uint64_t> undone;  // by edit, the event that undid it
};

}  // namespace

TEST_CASE("accepted for good are exactly the calls whose edits lasted, as a replay shows") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  const Fate fate(file);
  unsigned for_good = 0;
  unsigned undone = 0;
  for (const Call& call : file.calls()) {
    const auto edits = fate.edits_of(call);
    const auto lasted = std::count_if(edits.begin(), edits.end(), [&](std::uint64_t edit) {
      return fate.lasting.contains(edit);
    });
    if (!call.accepted()) {
      CHECK_FALSE(call.undone);
      // What calls in it found for themselves may last, but for an outermost one, which leaves nothing.
      if (call.depth == 0) CHECK(edits.empty());
      continue;
    }
    CHECK(call.accepted_for_good() == !call.undone);
    if (edits.empty()) continue;
    CHECK(lasted == (call.undone ? 0 : static_cast<std::ptrdiff_t>(edits.size())));
    ++(call.undone ? undone : for_good);
    if (!call.undone) continue;
    std::uint64_t first = file.event_count();
    for (const std::uint64_t edit : edits) first = std::min(first, fate.undone.at(edit));
    CHECK(call.undone_with == file.call_at(first));
  }
  CHECK(for_good > 20);
  CHECK(undone > 20);
  // And every edit that lasted was made by a call that was accepted for good.
  for (const std::uint64_t edit : fate.lasting) {
    const std::uint32_t call = file.call_at(edit);
    REQUIRE(call != kNoCall);
    CHECK(file.calls()[call].accepted_for_good());
  }
  CHECK(file.edit_count() == fate.lasting.size() + fate.undone.size());
  CHECK(file.undo_count() == fate.undone.size());
}

TEST_CASE("a single undo takes along whoever was accepted while its edit stood, and nobody else") {
  const test::TempFolder folder;
  TetMesh mesh(test::shell_mesh({.degree = 5}));
  const std::array edge = {VertexHandle(0), VertexHandle(1)};
  {
    TraceRecorder recorder(folder / "one.trace", mesh, {});
    Workspace workspace(mesh);
    workspace.set_listener(&recorder);
    const auto begin = [&] { recorder.attempt_begins({"shell_transformation", edge, 0, ""}); };
    const auto end = [&](Verdict verdict) { recorder.attempt_ends(verdict, {}, {}); };
    begin();  // 0: will fail
    begin();  // 1: before there is anything to undo
    end(Verdict::accepted);
    {
      Transaction trial(mesh, workspace);
      begin();  // 2: makes one edit
      trial.add_vertex(Point(0, 0, 5));
      end(Verdict::accepted);
      begin();  // 3: found the mesh as 2 had left it
      end(Verdict::accepted);
      begin();  // 4: refused then, and not undone
      end(Verdict::no_improvement);
    }
    end(Verdict::no_improvement);
    begin();  // 5: makes the same edit, which lasts
    Transaction lasting(mesh, workspace);
    lasting.add_vertex(Point(0, 0, 5));
    lasting.keep();
    end(Verdict::accepted);
    recorder.finish();
  }
  const TraceFile file(folder / "one.trace");
  REQUIRE(file.calls().size() == 6);
  const auto ending = [&](std::size_t call) { return file.ending(file.calls()[call]); };
  CHECK(ending(1) == CallEnding::for_good);
  CHECK(ending(2) == CallEnding::undone);
  CHECK(ending(3) == CallEnding::undone);
  CHECK(is_refusal(ending(4)));
  CHECK(ending(5) == CallEnding::for_good);
  CHECK(file.calls()[2].undone_with == 0);
  CHECK(file.calls()[3].verdict_in_words() == "undone with call 0");
  CHECK(file.undo_count() == 1);
  CHECK(make_ledger(file).lasting == 1);
}

TEST_CASE("a call that was undone says with which call, which is around it") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  std::uint32_t seen = 0;
  for (std::uint32_t c = 0; c < file.calls().size(); ++c) {
    const Call& call = file.calls()[c];
    if (!call.undone) continue;
    ++seen;
    REQUIRE(call.undone_with < c);
    CHECK(file.calls()[call.undone_with].subtree_end > c);
    CHECK(call.verdict_text() == "undone with a caller");
    CHECK(call.verdict_in_words() == "undone with call " + std::to_string(call.undone_with));
    CHECK(file.ending(call) == CallEnding::undone);
  }
  CHECK(seen > 20);
}

TEST_CASE("each call is in one cell of the ledger, and the seconds of all are those of the run") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  const Ledger ledger = make_ledger(file);
  CHECK(ledger.all.total().calls == file.calls().size());
  LedgerRow sum;
  for (const LedgerRow& row : ledger.rows) sum += row;
  CHECK(sum.total().calls == file.calls().size());
  std::size_t by_operator = 0;
  for (const LedgerRow& row : ledger.by_operator()) by_operator += row.total().calls;
  CHECK(by_operator == file.calls().size());
  double outermost = 0;
  for (const Call& call : file.calls()) outermost += call.depth == 0 ? call.events.seconds() : 0;
  CHECK(ledger.all.total().seconds == doctest::Approx(outermost));
  const auto lasted = std::count_if(file.calls().begin(), file.calls().end(),
                                    [](const Call& call) { return call.accepted_for_good(); });
  CHECK(ledger.all.cell(CallEnding::for_good).calls == static_cast<std::size_t>(lasted));
  CHECK(ledger.edits > ledger.lasting);
  CHECK(std::accumulate(ledger.all.nearness.begin(), ledger.all.nearness.end(), std::size_t{0}) ==
        ledger.all.refused().calls);
}

TEST_CASE("the calls of a cell are as many as it says, the nearest to being accepted first") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  for (const LedgerRow& row : make_ledger(file).rows) {
    for (std::size_t i = 0; i < kEndingCount; ++i) {
      const auto ending = static_cast<CallEnding>(i);
      const auto calls = calls_in(file, {std::string(row.operator_name), row.level, ending, false});
      REQUIRE(calls.size() == row.cells[i].calls);
      for (const std::uint32_t c : calls) {
        CHECK(file.calls()[c].level == row.level);
        CHECK(file.ending(file.calls()[c]) == ending);
        CHECK(file.reason(file.calls()[c]).size() > 5);
      }
      CHECK(std::is_sorted(calls.begin(), calls.end(), [&](std::uint32_t a, std::uint32_t b) {
        return file.calls()[a].missing() < file.calls()[b].missing();
      }));
    }
  }
  CHECK(calls_in(file, {"", {}, {}, true}).size() == make_ledger(file).all.refused().calls);
}

TEST_CASE(
    "how near a refusal was stands in words, also where nothing was compared, and those come "
    "last") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  bool has_compared = false;
  std::size_t without = 0;
  for (const std::uint32_t c : calls_in(file, {"", {}, {}, true})) {
    const Call& call = file.calls()[c];
    if (call.has_qualities()) {
      has_compared = true;
      CHECK(without == 0);
      CHECK(call.missing_in_words() ==
            (call.missing() <= 0 ? "others" : fmt::format("{:.4f}", call.missing())));
    } else {
      ++without;
      CHECK(call.missing_in_words() == "-: nothing was compared");
    }
  }
  CHECK(has_compared);
  CHECK(without > 0);
  for (const Call& call : file.calls()) CHECK(call.accepted() == call.missing_in_words().empty());

  const Ledger ledger = make_ledger(file);
  const auto json = nlohmann::json::parse(ledger_json(file, ledger));
  std::size_t told = 0;
  for (std::size_t r = 0; r < ledger.rows.size(); ++r) {
    const LedgerRow& row = ledger.rows[r];
    for (std::size_t i = 0; i < kEndingCount; ++i) {
      const auto ending = static_cast<CallEnding>(i);
      if (row.cells[i].calls == 0) continue;
      const auto& cell = json["rows"][r]["endings"][std::string(name_of(ending))];
      REQUIRE(cell.contains("nearest_lacked") == is_refusal(ending));
      if (!is_refusal(ending)) continue;
      const auto calls = calls_in(file, {std::string(row.operator_name), row.level, ending, false});
      const Call& nearest = file.calls()[calls.front()];
      if (nearest.has_qualities()) {
        CHECK(cell["nearest_lacked"] == nearest.missing());
        CHECK_FALSE(cell.contains("why_none"));
      } else {
        ++told;
        CHECK(cell["nearest_lacked"].is_null());
        CHECK(cell["why_none"] == "nothing was compared");
      }
    }
  }
  CHECK(told > 0);
  CHECK(format_ledger(ledger).find("  -: nothing was compared\n") != std::string::npos);
}

TEST_CASE("a ledger of events alone is that of a trace whose mesh was followed") {
  const test::TracedBall trace;
  const TraceFile events(trace.path(), TraceCheck::events);
  CHECK(events.last_mesh() == nullptr);
  CHECK(format_ledger(make_ledger(events)) == format_ledger(make_ledger(TraceFile(trace.path()))));
}

TEST_CASE("a ledger is written for people and for programs, with the same numbers") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  const Ledger ledger = make_ledger(file);
  const auto json = nlohmann::json::parse(ledger_json(file, ledger));
  std::size_t calls = 0;
  for (const auto& row : json["rows"]) {
    double share = 0;
    for (const auto& [name, cell] : row["endings"].items()) {
      calls += cell["calls"].get<std::size_t>();
      share += cell["share"].get<double>();
    }
    CHECK(share == doctest::Approx(1));
  }
  CHECK(calls == file.calls().size());
  CHECK(json["edits"]["lasting"] == ledger.lasting);
  const std::string text = format_ledger(ledger);
  for (const LedgerRow& row : ledger.rows) {
    CHECK(text.find(std::string(row.operator_name)) != std::string::npos);
  }
  CHECK(text.find(fmt::format("{} calls: {} accepted for good, {} accepted and undone",
                              file.calls().size(), ledger.all.cell(CallEnding::for_good).calls,
                              ledger.all.cell(CallEnding::undone).calls)) == 0);
}

TEST_CASE("a call that a cut trace does not see end is in the ledger as cut off") {
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
  const Ledger ledger = make_ledger(file);
  CHECK(ledger.all.cell(CallEnding::cut_off).calls == 1);
  CHECK(ledger.all.refused().calls == 0);
  CHECK(ledger.all.total().calls == 1);
}
