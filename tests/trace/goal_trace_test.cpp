// SPDX-License-Identifier: MIT
// A run that changes its goal: the trace says so, and replay judges as the run did.
#include <doctest/doctest.h>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"
#include "tests/support/traced_run.h"
#include "trace/replay.h"
#include "trace/trace_file.h"
#include "trace/trace_summary.h"
#include "trace/traced_standard.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const Schedule kThreeGoals("goals", R"(
    smooth{}
    goal{min = 40, max = 130}
    smooth{}
    local_reconnection{}
    goal{min = 20}
    judge_by{measure = "sine", price = 0.05}
    smooth{})");

TetMesh priced_sheet() {
  TetMesh mesh = asset_mesh("sheet.mesh");
  mesh.set_standard(Standard(Goal{}, Standard::Terms::sine_and_length, 0.1));
  return mesh;
}

std::size_t count_bad(const SlotMesh& mesh) {
  std::size_t bad = 0;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (!mesh.is_deleted(TetHandle(i)) && misses_goal(mesh, TetHandle(i))) ++bad;
  }
  return bad;
}

}  // namespace

TEST_CASE("replay judges by the goal in force, forwards, backwards and from keyframes") {
  const TempFolder folder;
  TetMesh mesh = priced_sheet();
  record(mesh, folder / "trace", {}, {}, kThreeGoals);
  const TraceFile file(folder / "trace");
  REQUIRE(file.passes().size() == 4);
  const Standard first = Standard(Goal{}, Standard::Terms::sine_and_length, 0.1);
  const Standard second = Standard({40, 130}, Standard::Terms::sine_and_length, 0.1);
  const Standard third = Standard({20, 160}, Standard::Terms::sine, 0.05);
  CHECK(file.passes()[0].standard == first);
  CHECK(file.passes()[1].standard == second);
  CHECK(file.passes()[2].standard == second);
  CHECK(file.passes()[3].standard == third);
  CHECK(mesh.standard() == third);
  for (const std::uint64_t distance : {Replay::kDefaultDistance, std::uint64_t{1}}) {
    Replay replay(file, Replay::kDefaultMemory, distance);
    for (const std::size_t i : {0, 1, 2, 3, 2, 1, 0, 3, 0}) {
      CAPTURE(i);
      const TracedPass& pass = file.passes()[i];
      replay.seek(pass.events.end);
      CHECK(replay.mesh().standard() == pass.standard);
      CHECK(count_bad(replay.mesh()) == pass.now.n_bad);
    }
    // Across the change itself, event by event.
    const std::uint64_t change = file.passes()[0].events.end;
    replay.seek(change);
    CHECK(replay.mesh().standard() == first);
    replay.seek(change + 1);
    CHECK(replay.mesh().standard() == second);
    CHECK(replay.cavity().created.empty());
    replay.seek(change);
    CHECK(replay.mesh().standard() == first);
    replay.seek(file.event_count());
    CHECK(replay.mesh().fingerprint() == SlotMesh(mesh).fingerprint());
  }
}

TEST_CASE("the summary of a trace tells the goal, and each other one where it begins") {
  const TempFolder folder;
  TetMesh mesh = priced_sheet();
  record(mesh, folder / "trace", {}, {}, kThreeGoals);
  const TraceFile file(folder / "trace");
  const std::string text = format_summary(file, summarize(file));
  CHECK(contains(text, "goal: 30 to 150 degrees, by sine_and_length, price 0.1\n"));
  const std::size_t second = text.find("goal: 40 to 130 degrees, by sine_and_length, price 0.1\n");
  const std::size_t third = text.find("goal: 20 to 160 degrees, by sine, price 0.05\n");
  REQUIRE(second != std::string::npos);
  REQUIRE(third != std::string::npos);
  CHECK(second < text.find("local_reconnection", second));
  CHECK(text.find("local_reconnection", second) < third);
}

TEST_CASE("a standard that is none is damage") {
  ByteWriter out;
  put_standard(out, Standard());  // no goal
  ByteReader in(out.bytes());
  CHECK_THROWS_AS(get_standard(in), ByteReader::Damage);
  ByteWriter sound;
  put_standard(sound, Standard({20, 140}, Standard::Terms::sine, 0.2));
  ByteReader again(sound.bytes());
  CHECK(get_standard(again) == Standard({20, 140}, Standard::Terms::sine, 0.2));
}
