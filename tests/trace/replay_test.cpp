// SPDX-License-Identifier: MIT
#include "trace/replay.h"

#include <algorithm>
#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/traced_run.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

struct RecordedStates {
  TempFolder folder;
  std::map<std::uint64_t, std::uint64_t> truth;

  RecordedStates(const std::string& mesh_name, const Schedule& schedule,
                 const TraceFilter& filter = {}) {
    TetMesh mesh = asset_mesh(mesh_name);
    TetMesh again = mesh;
    record(mesh, folder / "trace", filter, {}, schedule);
    const std::uint64_t events = TraceFile(folder / "trace").event_count();
    std::set<std::uint64_t> wanted = random_numbers(330, events);
    wanted.insert({0, events});
    truth = record(again, folder / "trace", filter, wanted, schedule);
  }
};

/// Where the replay differs from the run, visiting in the order given.
std::vector<std::uint64_t> differences(Replay& replay, const RecordedStates& recorded,
                                       const std::vector<std::uint64_t>& order) {
  std::vector<std::uint64_t> wrong;
  for (const std::uint64_t k : order) {
    replay.seek(k);
    if (replay.mesh().fingerprint() != recorded.truth.at(k)) wrong.push_back(k);
  }
  return wrong;
}

void check_both_ways(const RecordedStates& recorded, std::size_t memory = Replay::kDefaultMemory,
                     std::uint64_t distance = Replay::kDefaultDistance) {
  const TraceFile file(recorded.folder / "trace");
  REQUIRE(recorded.truth.size() > 300);
  std::vector<std::uint64_t> order;
  for (const auto& [k, print] : recorded.truth) order.push_back(k);
  Replay replay(file, memory, distance);
  CHECK(differences(replay, recorded, order).empty());
  std::reverse(order.begin(), order.end());
  CHECK(differences(replay, recorded, order).empty());
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  CHECK(differences(replay, recorded, order).empty());
  Replay still(file, memory, distance);
  const SlotMesh& last = still.mesh_at(file.event_count());
  CHECK(still.position() == 0);  // the file has it
  CHECK(last.fingerprint() == recorded.truth.at(file.event_count()));
  replay.seek(file.event_count());
  CHECK(last.standard() == replay.mesh().standard());
}

}  // namespace

TEST_CASE("the mesh at hundreds of events is the one that the run had, in any order") {
  const RecordedStates recorded("folded_sheet.mesh", Schedule::builtin("shell"));
  SUBCASE("as a user has it") {
    check_both_ways(recorded);
  }
  SUBCASE("with a keyframe at every chunk and short logs") {
    check_both_ways(recorded, Replay::kDefaultMemory, 1);
  }
  SUBCASE("without keyframes") {
    check_both_ways(recorded, 0);
  }
}

TEST_CASE("replay knows labels, insertions of vertices and their undoing") {
  const Schedule schedule("all", R"(
    apply("centroid_insertion") apply("circumcentre_insertion") suppress_points{}
    insert_points{} local_reconnection{} smooth{})");
  check_both_ways(RecordedStates("two_materials.mesh", schedule));
}

TEST_CASE("a step back and a step forth give the mesh of before") {
  const RecordedStates recorded("sheet.mesh", Schedule("brief", "local_reconnection{} smooth{}"));
  const TraceFile file(recorded.folder / "trace");
  Replay replay(file);
  replay.seek(file.event_count() / 2);
  std::vector<std::uint64_t> way;
  for (int i = 0; i < 500; ++i) {
    way.push_back(replay.mesh().fingerprint());
    replay.seek(replay.position() + 1);
  }
  std::size_t wrong = 0;
  for (; !way.empty(); way.pop_back()) {
    replay.seek(replay.position() - 1);
    if (replay.mesh().fingerprint() != way.back()) ++wrong;
  }
  CHECK(wrong == 0);
}

TEST_CASE("the cavity of an event tells the mesh before it from the mesh after it") {
  const RecordedStates recorded("sheet.mesh", Schedule("brief", "local_reconnection{} smooth{}"));
  const TraceFile file(recorded.folder / "trace");
  Replay replay(file);
  EventCursor events(file);
  std::size_t wrong = 0;
  std::size_t cavities = 0;
  for (std::uint64_t k = 0; k < file.event_count(); ++k) {
    const std::size_t tets = replay.mesh().tet_count();
    replay.seek(k + 1);
    const Cavity cavity = replay.cavity();
    const bool changes = changes_mesh(events.next().kind);
    if (changes == (cavity.removed.empty() && cavity.vertices.empty())) ++wrong;
    if (tets + cavity.created.size() != replay.mesh().tet_count() + cavity.removed.size()) ++wrong;
    for (const CavityTet& t : cavity.created) {
      if (replay.mesh().vertices(t.tet) != t.vertices) ++wrong;
    }
    cavities += changes ? 1 : 0;
  }
  CHECK(cavities > 100);
  CHECK(wrong == 0);
}

TEST_CASE("the cavity of an event is the same from whichever side one comes to it") {
  // Of attempts that are left out only the edits are there: a chunk may begin right after one.
  const TempFolder folder;
  TetMesh mesh = asset_mesh("bracket.meshb");
  record(mesh, folder / "trace", {.operators = {"edge_split"}}, {},
         Schedule("moves", "smooth{on = {below = 1}, cycles = 5}"));
  const TraceFile file(folder / "trace");
  const auto sizes = [](const Cavity& cavity) {
    return std::array{cavity.removed.size(), cavity.created.size(), cavity.vertices.size()};
  };
  std::vector<std::array<std::size_t, 3>> truth(1);
  Replay forwards(file, 0);
  for (std::uint64_t k = 1; k <= file.event_count(); ++k) {
    forwards.seek(k);
    truth.push_back(sizes(forwards.cavity()));
  }
  Replay replay(file, Replay::kDefaultMemory, 1);
  std::size_t wrong = 0;
  std::size_t cavities = 0;
  REQUIRE(file.chunk_begins().size() > 2);
  for (const std::uint64_t begin : file.chunk_begins()) {
    for (const std::uint64_t from : {std::uint64_t{0}, file.event_count()}) {
      replay.seek(from);
      replay.seek(begin);
      if (sizes(replay.cavity()) != truth[begin]) ++wrong;
    }
    cavities += truth[begin] != truth[0] ? 1 : 0;
  }
  CHECK(cavities > 0);
  CHECK(wrong == 0);
}

TEST_CASE("qualities of a replayed mesh are those of the mesh, bit for bit") {
  const TempFolder folder;
  TetMesh mesh = asset_mesh("sheet.mesh");
  record(mesh, folder / "trace");
  const TraceFile file(folder / "trace");
  Replay replay(file);
  replay.seek(file.event_count());
  std::size_t wrong = 0;
  for (const TetHandle t : live_tets(mesh)) {
    if (replay.mesh().quality(t) != mesh.quality(t)) ++wrong;
  }
  CHECK(wrong == 0);
  CHECK(replay.mesh().tet_count() == mesh.tet_count());
}
