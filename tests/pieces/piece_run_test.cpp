// SPDX-License-Identifier: MIT
#include "pieces/piece_run.h"

#include <string>

#include <doctest/doctest.h>

#include "ops/registry.h"
#include "pieces/slices.h"
#include "tests/pieces/meshes.h"
#include "tests/support/registry.h"

using namespace tetmend;
using namespace tetmend::pieces;
using namespace tetmend::test;

namespace {

std::string value_of(const ScheduleSettings& settings, std::string_view name) {
  for (const auto& [key, value] : settings) {
    if (key == name) return value;
  }
  return "";
}

/// Works on the mesh in that many pieces, without zones.
RunState state_after(const MeshData& data, std::size_t pieces, bool measures_before) {
  MemoryShelf shelf;
  OneRank ranks;
  DividedMesh mesh(shelf, ranks, data.points.size());
  add_slices(data, {}, mesh);
  mesh.end_slices();
  const Schedule& schedule = Schedule::builtin("shell");
  const AimSettings settings(schedule, {{"max_rounds", "1"}});
  const TaskOptions options{kRegistry, schedule, settings, Standard(Goal{})};
  Division division;
  division.pieces = pieces;
  division.zone_rounds = 0;
  PieceRun run(mesh, division, options);
  if (measures_before) run.measure_before();
  run.run();
  return run.state();
}

}  // namespace

TEST_CASE("pieces leave the worst to zones, as far as the schedule can and the user lets it") {
  const Schedule& shell = Schedule::builtin("shell");
  const AimSettings usual(shell, {{"max_rounds", "3"}});
  CHECK(usual.of(Aim::all) ==
        ScheduleSettings{{"max_rounds", "3"}, {"polish_first", "0"}, {"polish_last", "0"}});
  CHECK(value_of(usual.of(Aim::but_worst), "worst_later") == "true");
  CHECK(value_of(usual.of(Aim::but_worst), "worst_only").empty());
  CHECK(value_of(usual.of(Aim::worst), "worst_only") == "true");
  CHECK(value_of(usual.of(Aim::worst), "max_rounds") == "3");
  const AimSettings chosen(shell, {{"worst_later", "false"}});
  CHECK(value_of(chosen.of(Aim::but_worst), "worst_later") == "false");
  const AimSettings other(Schedule::builtin("thorough"), {});
  CHECK(other.of(Aim::worst).empty());
}

TEST_CASE("what no tet of a piece may become is what none of the whole mesh was") {
  const MeshData data = test::lattice(6);
  TetMesh whole(data);
  whole.set_standard(Standard(Goal{}));
  const Bounds expected = Bounds::of(whole);
  for (const std::size_t pieces : {2, 5}) {
    CAPTURE(pieces);
    const RunState state = state_after(data, pieces, false);
    REQUIRE(state.bounds.has_value());
    const Quality safe = state.bounds->under(whole.standard()).safe();
    CHECK(safe == doctest::Approx(expected.safe()));
    const RunState measured = state_after(data, pieces, true);
    CHECK(measured.bounds->under(whole.standard()).safe() == safe);
    // Another program that goes on has the same.
    std::string bytes;
    append(state, bytes);
    std::string_view rest = bytes;
    const RunState taken = take_run_state(rest);
    CHECK(taken.bounds->under(whole.standard()).safe() == safe);
  }
}
