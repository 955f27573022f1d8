// SPDX-License-Identifier: MIT
// What a trace answers about a tet, an edge or a vertex.
#include "trace/history.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/error.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/traced_run.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// A recorded run, and what it wrote.
struct RecordedRun {
  explicit RecordedRun(const std::string& name = "sheet.mesh") : mesh(asset_mesh(name)) {
    record(mesh, path);
    write_mesh(after, mesh.to_data());
  }

  TempFolder folder;
  TetMesh mesh;
  std::filesystem::path before =
      std::filesystem::path(TETMEND_SOURCE_DIR) / "assets/meshes/sheet.mesh";
  std::filesystem::path after = folder / "after.mesh";
  std::filesystem::path path = folder / "run.trace";
};

bool is_there(const SlotMesh& mesh, const HistorySubject& subject) {
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    const TetVertices& tet = mesh.vertices(t);
    const auto is_corner = [&](VertexHandle v) {
      return std::count(tet.begin(), tet.end(), v) > 0;
    };
    if (std::all_of(subject.begin(), subject.end(), is_corner)) return true;
  }
  return false;
}

std::string history_refusal(const TraceFile& file, const std::string& text) {
  Replay replay(file, 0);
  try {
    history_of(file, replay, find_subject(file, replay, text));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a tet of the mesh that a run wrote is found in its trace, with what made it") {
  const RecordedRun run;
  const TraceFile file(run.path);
  Replay replay(file);
  const MeshData after = read_mesh(run.after);
  unsigned made = 0;
  for (std::size_t t = 1; t <= after.tets.size(); t += 97) {
    CAPTURE(t);
    const std::string name = fmt::format("tet:{}@{}", t, run.after.string());
    const HistorySubject subject = find_subject(file, replay, name);
    const History history = history_of(file, replay, subject);
    CHECK(!history.removed);
    CHECK(history.parts.size() == 15);
    const auto [least, most] = std::minmax_element(history.angles.begin(), history.angles.end());
    CHECK(*least > 0);
    CHECK(*most < 180);
    replay.seek(history.made);
    CHECK(is_there(replay.mesh(), subject) == history.from_beginning);
    replay.seek(file.event_count());
    CHECK(is_there(replay.mesh(), subject));
    if (history.from_beginning) continue;
    ++made;
    replay.seek(history.made + 1);
    CHECK(is_there(replay.mesh(), subject));
    REQUIRE(history.made_by != kNoCall);
    CHECK(file.calls()[history.made_by].accepted());
    for (const HistoryCall& each : history.calls) {
      CHECK(file.calls()[each.call].events.begin >= history.made);
    }
  }
  CHECK(made > 5);
}

TEST_CASE("a tet that a run removed is found by its file, with the call that removed it") {
  const RecordedRun run;
  const TraceFile file(run.path);
  Replay replay(file);
  unsigned removed = 0;
  const std::size_t tets = read_mesh(run.before).tets.size();
  for (std::size_t t = 1; t <= tets; t += 61) {
    const auto subject =
        find_subject(file, replay, fmt::format("tet:{}@{}", t, run.before.string()));
    const History history = history_of(file, replay, subject);
    if (!history.from_beginning || !history.removed) continue;
    ++removed;
    replay.seek(*history.removed);
    CHECK(is_there(replay.mesh(), subject));
    replay.seek(*history.removed + 1);
    CHECK(!is_there(replay.mesh(), subject));
    replay.seek(file.event_count());
    CHECK(!is_there(replay.mesh(), subject));
    CHECK(history_text(file, history).find("was removed by call") != std::string::npos);
  }
  CHECK(removed > 5);
}

TEST_CASE("calls in trials are told apart from those that worked on the mesh that stayed") {
  const RecordedRun run("folded_sheet.mesh");
  const TraceFile file(run.path);
  Replay replay(file);
  // Of a refused outermost call all edits are undone: what it calls while one stands is a trial.
  std::vector<int> open_edits(file.calls().size(), 0);
  EventCursor cursor(file);
  int edits = 0;
  std::uint32_t next = 0;
  for (std::uint64_t k = 0; k < file.event_count(); ++k) {
    const EventKind kind = cursor.next().kind;
    if (kind == EventKind::attempt_begins) {
      if (file.calls()[next].depth == 0) edits = 0;
      open_edits[next++] = edits;
    }
    if (kind == EventKind::undo) {
      --edits;
    } else if (changes_mesh(kind)) {
      ++edits;
    }
  }
  unsigned trials = 0;
  unsigned others = 0;
  replay.seek(file.event_count());
  std::vector<std::pair<Quality, std::uint32_t>> worst;
  for (std::uint32_t i = 0; i < replay.mesh().tet_slots(); ++i) {
    if (replay.mesh().is_deleted(TetHandle(i))) continue;
    worst.emplace_back(replay.mesh().quality(TetHandle(i)), i);
  }
  std::sort(worst.begin(), worst.end());
  worst.resize(10);
  for (const auto& [quality, tet] : worst) {
    const auto subject = find_subject(file, replay, fmt::format("tet:{}", tet));
    for (const HistoryCall& each : history_of(file, replay, subject).calls) {
      std::uint32_t root = each.call;
      while (file.calls()[root].parent != kNoCall) root = file.calls()[root].parent;
      if (root == each.call) CHECK(!each.in_trial);
      if (file.calls()[root].accepted()) continue;
      CHECK(each.in_trial == (open_edits[each.call] > 0));
      each.in_trial ? ++trials : ++others;
    }
  }
  CHECK(others > 0);
  CHECK(trials > 0);
}

TEST_CASE("the worst tet, an edge and a vertex are asked for by numbers of the trace") {
  const RecordedRun run;
  const TraceFile file(run.path);
  Replay replay(file);
  const HistorySubject worst = find_subject(file, replay, "tet:worst");
  REQUIRE(worst.size() == 4);
  const History of_worst = history_of(file, replay, worst);
  replay.seek(file.event_count());
  for (std::uint32_t i = 0; i < replay.mesh().tet_slots(); ++i) {
    if (replay.mesh().is_deleted(TetHandle(i))) continue;
    CHECK(replay.mesh().quality(TetHandle(i)) >= of_worst.quality);
  }
  const auto edge = fmt::format("edge:{},{}", worst[2].index(), worst[0].index());
  const History of_edge = history_of(file, replay, find_subject(file, replay, edge));
  CHECK(of_edge.subject == HistorySubject{worst[0], worst[2]});
  CHECK(!of_edge.removed);
  for (const HistoryCall& each : of_edge.calls) CHECK(file.calls()[each.call].target_size <= 2);
  CHECK(history_paragraph(file, of_edge).find("4 vertices") == std::string::npos);
  const auto vertex = fmt::format("vertex:{}", worst[1].index());
  CHECK(history_of(file, replay, find_subject(file, replay, vertex)).parts.size() == 1);
}

TEST_CASE("of an edge or a face, too, the call that came nearest is named; of a vertex none is") {
  const RecordedRun run;
  const TraceFile file(run.path);
  Replay replay(file);
  unsigned named = 0;
  const HistorySubject tet = find_subject(file, replay, "tet:worst");
  for (const PartHistory& part : history_of(file, replay, tet).parts) {
    const HistorySubject subject = find_subject(file, replay, as_question(part.part));
    const History history = history_of(file, replay, subject);
    const std::string text = history_paragraph(file, history);
    CAPTURE(text);
    const bool tells = text.find("Nearest came") != std::string::npos ||
                       text.find("the last answer") != std::string::npos;
    if (part.part.size() == 1) CHECK_FALSE(tells);
    const std::uint32_t nearest = history.parts.front().nearest;  // of the subject itself
    if (subject.size() != 2 || nearest == kNoCall || file.calls()[nearest].accepted()) continue;
    ++named;
    CHECK(text.find(fmt::format("call {} ", nearest)) != std::string::npos);
  }
  CHECK(named > 0);
}

TEST_CASE("a tet that no pass turned to is told so") {
  const RecordedRun run;
  const TraceFile file(run.path);
  Replay replay(file);
  replay.seek(file.event_count());
  std::uint32_t best = 0;
  for (std::uint32_t i = 0; i < replay.mesh().tet_slots(); ++i) {
    if (replay.mesh().is_deleted(TetHandle(i))) continue;
    if (replay.mesh().is_deleted(TetHandle(best)) ||
        replay.mesh().quality(TetHandle(i)) > replay.mesh().quality(TetHandle(best))) {
      best = i;
    }
  }
  const HistorySubject subject = find_subject(file, replay, fmt::format("tet:{}", best));
  const History history = history_of(file, replay, subject);
  REQUIRE(history.visits.empty());
  CHECK(history_paragraph(file, history).find("No pass wanted to get rid of it.") !=
        std::string::npos);
}

TEST_CASE("a refused call whose worst tet was better is told with what else counted") {
  const TempFolder folder;
  const std::filesystem::path path = folder / "refused.trace";
  const TetMesh mesh = asset_mesh("sheet.mesh");
  const TetVertices tet = mesh.vertices(TetHandle(0));
  const std::array edge = {tet[0], tet[1]};
  const std::vector<Quality> before = {0.6112F, 1.2F};
  const std::vector<Quality> now = {0.6304F, 0.7F, 0.8F};
  const auto paragraph_of = [&](const std::vector<Quality>& old,
                                const std::vector<Quality>& tried) {
    {
      TraceRecorder recorder(path, mesh, {});
      recorder.attempt_begins({"edge_contraction", edge, 0, {}});
      recorder.candidate_found();
      recorder.attempt_ends(Verdict::no_improvement, old, tried);
      recorder.finish();
    }
    const TraceFile file(path);
    Replay replay(file);
    const HistorySubject subject = find_subject(file, replay, "tet:0");
    return history_paragraph(file, history_of(file, replay, subject));
  };
  const auto says = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  const std::string dear = paragraph_of(before, now);
  CAPTURE(dear);
  CHECK(says(dear,
             "its worst tet had quality 0.6304, as against 0.6112, with 3 bad tets in place "
             "of 1: the quality vector is better, but the gain does not pay for more bad "
             "tets."));
  CHECK(says(paragraph_of(now, {0.7F, 0.7F, 0.7F}),
             "quality 0.7000, as against 0.6304: the quality vector is better, but not all that "
             "its judge asks for is."));
  CHECK(
      says(paragraph_of(now, before),
           "had quality 0.6112 and needed more than 0.6304: the quality vector with the candidate "
           "is not better."));
}

TEST_CASE("questions that name nothing are refused with a reason") {
  const RecordedRun run;
  const TraceFile file(run.path);
  for (const char* text :
       {"", "tet", "tet:", "tet:x", "tet:1,2", "tet:1,2,3,3", "edge:4", "edge:4,4", "vertex:1,2",
        "ball:3", "tet:worst@a.mesh", "tet:3@", "edge:1;2"}) {
    CAPTURE(text);
    CHECK(history_refusal(file, text).find("names nothing in a trace: expected tet:N") !=
          std::string::npos);
  }
  CHECK(history_refusal(file, "tet:99999999")
            .starts_with("there is no tet 99999999 when the trace ends"));
  CHECK(history_refusal(file, "edge:99999998,99999999").find("nothing of the kind") !=
        std::string::npos);
  CHECK(history_refusal(file, "tet:0@" + run.after.string()).find("has no tet 0") !=
        std::string::npos);
  CHECK(history_refusal(file, "tet:1@/nowhere.mesh").find("/nowhere.mesh") != std::string::npos);
  const TempFolder other;
  MeshData far;
  far.points = {{1e9, 0, 0}, {2e9, 0, 0}, {1e9, 1, 0}, {1e9, 0, 1}};
  far.tets = {{{0, 1, 2, 3}, 0}};
  write_mesh(other / "far.mesh", far);
  CHECK(history_refusal(file, "tet:1@" + (other / "far.mesh").string())
            .find("no vertices at these places") != std::string::npos);
}

TEST_CASE("a history that is cut short has the calls that came nearest, and counts the others") {
  const RecordedRun run("folded_sheet.mesh");
  const TraceFile file(run.path);
  Replay replay(file, 0);
  const History history = history_of(file, replay, find_subject(file, replay, "tet:worst"));
  REQUIRE(history.calls.size() > 8);
  constexpr std::size_t kMost = 5;
  const std::string whole = history_text(file, history);
  const std::string cut = history_text(file, history, kMost);
  const std::string answer = history_paragraph(file, history) + "\n";
  CHECK(whole.ends_with("\n\n" + answer));
  CHECK(cut.ends_with("\n\n" + answer));
  CHECK(whole.find("more, in trials") == std::string::npos);
  CHECK(cut.find(fmt::format("{:>9}  more, in trials", history.calls.size() - kMost)) !=
        std::string::npos);
  const auto has_row = [&](const std::string& text, std::uint32_t call) {
    return text.find(fmt::format("\n{:>9}  {}", call,
                                 file.name(file.calls()[call].operator_name))) != std::string::npos;
  };
  std::size_t rows = 0;
  for (const HistoryCall& each : history.calls) {
    CHECK(has_row(whole, each.call));
    rows += has_row(cut, each.call) ? 1 : 0;
  }
  CHECK(rows == kMost);
  // The one that the answer names as the nearest is among them.
  const std::size_t at = answer.find("Nearest came call ");
  REQUIRE(at != std::string::npos);
  CHECK(has_row(cut, static_cast<std::uint32_t>(std::stoul(answer.substr(at + 18)))));
}
