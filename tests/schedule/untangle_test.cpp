// SPDX-License-Identifier: MIT
// The pass that untangles: what it repairs, and what it must not touch.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/statistics.h"
#include "schedule/passes.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/registry.h"
#include "tests/support/stopper.h"
#include "tests/support/threads.h"
#include "tests/support/traced_run.h"
#include "trace/replay.h"
#include "trace/trace_file.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

double share_of_inverted(const TetMesh& mesh) {
  return static_cast<double>(count_not_positive(mesh)) / static_cast<double>(mesh.tet_count());
}

/// Checks that what is fixed is where it was, and each tet has the vertices that it had.
void check_fixed_kept(const TetMesh& before, const TetMesh& mesh) {
  CHECK(to_string(check_integrity(mesh)) == "");
  CHECK(mesh.tet_count() == before.tet_count());
  for (const VertexHandle v : live_vertices(before)) {
    if (before.is_fixed(v)) CHECK(mesh.point(v) == before.point(v));
  }
  for (const TetHandle t : live_tets(before)) CHECK(mesh.vertices(t) == before.vertices(t));
}

}  // namespace

TEST_CASE("tangled cubes of all kinds become sound, and what is fixed stays") {
  double least = 1;
  double most = 0;
  for (const double jitter : {0.85, 1.2, 2.0, 10.0}) {
    for (const std::uint64_t seed : {1u, 2u}) {
      CAPTURE(jitter);
      CAPTURE(seed);
      TetMesh mesh(kuhn_cube(7, jitter, seed));
      const TetMesh before = mesh;
      least = std::min(least, share_of_inverted(mesh));
      most = std::max(most, share_of_inverted(mesh));
      Run run(mesh, kRegistry);
      untangle(run, {.where = {.share = 0.05}});
      CHECK(count_not_positive(mesh) == 0);
      check_fixed_kept(before, mesh);
      REQUIRE(run.records.size() == 1);
      CHECK(run.records[0].name == "untangle");
      CHECK(run.records[0].accepted() == 1);
      CHECK(run.records[0].attempts() == 1);
      REQUIRE(run.notes.size() == 1);
      CHECK(run.notes[0] == "untangle: 0 of " + std::to_string(count_not_positive(before)) +
                                " inverted or flat tets are left where they were many");
    }
  }
  CHECK(least < 0.2);
  CHECK(most > 0.42);
}

TEST_CASE("where little or nothing is tangled, untangling does nothing and leaves no record") {
  for (const MeshData& data : {kuhn_cube(5, 0.2, 1), tangled_ball(200, 1)}) {
    TetMesh mesh(data);
    const TetMesh before = mesh;
    Run run(mesh, kRegistry);
    untangle(run);
    CHECK(mesh == before);
    CHECK(run.records.empty());
    CHECK(run.notes.empty());
  }
}

TEST_CASE("the number of threads does not show in an untangled mesh") {
  std::vector<TetMesh> meshes;
  for (const int threads : {1, 2, 3, 8}) {
    on_threads(threads, [&] {
      TetMesh& mesh = meshes.emplace_back(kuhn_cube(13, 1.8, 1));
      Run run(mesh, kRegistry);
      untangle(run);
      CHECK(count_not_positive(mesh) == 0);
    });
    CHECK(meshes.back() == meshes.front());
  }
}

TEST_CASE("a face between two labels stays where it is, and both sides are untangled") {
  MeshData data = kuhn_cube(8, 1.8, 3);
  const MeshData at_rest = kuhn_cube(8, 0, 3);
  for (std::size_t v = 0; v < data.points.size(); ++v) {
    if (std::abs(at_rest.points[v].z() - 0.5) < 1e-9) data.points[v] = at_rest.points[v];
  }
  for (MeshData::Tet& tet : data.tets) {
    double z = 0;
    for (const std::uint32_t v : tet.vertices) z += at_rest.points[v].z() / 4;
    tet.label = z < 0.5 ? 1 : 2;
  }
  TetMesh mesh(data);
  const TetMesh before = mesh;
  REQUIRE(share_of_inverted(mesh) > 0.25);
  Run run(mesh, kRegistry);
  untangle(run);
  CHECK(run.records.at(0).accepted() == 2);  // the sides have no free vertex in common
  CHECK(count_not_positive(mesh) == 0);
  check_fixed_kept(before, mesh);
}

TEST_CASE("untangling that is stopped leaves each tangle as it was") {
  for (const int reports : {1, 2, 5, 10, 40}) {
    TetMesh mesh(kuhn_cube(8, 1.8, 1));
    const TetMesh before = mesh;
    Run run(mesh, kRegistry);
    Stopper stopper(reports);
    run.set_listener(&stopper);
    run.set_cancel_flag(&stopper.cancel);
    on_threads(1, [&] { untangle(run); });  // of several, some reports are not heard
    REQUIRE(stopper.cancel);
    CHECK(mesh == before);
  }
  TetMesh mesh(kuhn_cube(8, 1.8, 1));
  const TetMesh before = mesh;
  Run run(mesh, kRegistry);
  run.set_time_limit(0);
  untangle(run);
  CHECK(mesh == before);
}

TEST_CASE("where fixed vertices force inverted tets, the others become positive") {
  MeshData data = kuhn_cube(8, 1.5, 1);
  // The middle of a side of the cube goes in too deep, past vertices that are required.
  const MeshData at_rest = kuhn_cube(8, 0, 1);
  for (std::size_t v = 0; v < data.points.size(); ++v) {
    const Point& p = at_rest.points[v];
    const bool is_middle = (p - Point(0.5, 0.5, 0.5)).norm() < 0.2;
    if (is_middle) data.required_vertices.push_back(static_cast<std::uint32_t>(v));
  }
  TetMesh mesh(data);
  const TetMesh before = mesh;
  const std::size_t inverted = count_not_positive(mesh);
  std::size_t forced = 0;
  for (const TetHandle t : live_tets(mesh)) {
    const TetVertices& v = mesh.vertices(t);
    const bool is_fixed =
        std::all_of(v.begin(), v.end(), [&](VertexHandle w) { return mesh.is_fixed(w); });
    if (is_fixed && mesh.quality(t) <= 0) ++forced;
  }
  REQUIRE(forced > 5);
  Run run(mesh, kRegistry);
  untangle(run);
  CHECK(run.records.at(0).accepted() == 1);
  CHECK(count_not_positive(mesh) >= forced);
  CHECK(count_not_positive(mesh) < forced + inverted / 10);
  check_fixed_kept(before, mesh);
}

TEST_CASE("a tangle that nothing helps is left as it was") {
  TetMesh mesh(kuhn_cube(8, 1.8, 1));
  const TetMesh before = mesh;
  Run run(mesh, kRegistry);
  untangle(run, {.looks = 1});
  CHECK(count_not_positive(mesh) <= count_not_positive(before));
  check_fixed_kept(before, mesh);
  if (run.records.at(0).accepted() == 0) CHECK(mesh == before);
}

TEST_CASE("a trace has each tangle as one call, and its replay is exact") {
  const TempFolder folder;
  TetMesh mesh(kuhn_cube(7, 1.8, 1));
  const TetMesh before = mesh;
  record(mesh, folder / "trace", {}, {}, Schedule("untangle", "untangle{}"));
  REQUIRE(count_not_positive(mesh) == 0);
  const TraceFile file(folder / "trace");
  CHECK(file.damage().empty());
  REQUIRE(file.calls().size() == 1);
  const Call& call = file.calls()[0];
  CHECK(file.name(call.operator_name) == kUntanglingName);
  CHECK(call.verdict == Verdict::accepted);
  CHECK(call.worst_before < 0);
  CHECK(call.worst_after > 0);
  Replay replay(file, 0);
  CHECK(replay.mesh().fingerprint() == SlotMesh(before).fingerprint());
  replay.seek(file.event_count());
  CHECK(replay.mesh().fingerprint() == SlotMesh(mesh).fingerprint());
  replay.seek(0);
  CHECK(replay.mesh().fingerprint() == SlotMesh(before).fingerprint());
}

TEST_CASE("a script reads what untangling did, and bounds where it is done") {
  const auto notes = [](const MeshData& data, const std::string& script) {
    TetMesh mesh(data);
    Run run(mesh, kRegistry);
    improve(run, Schedule("test", script));
    return run.notes.back();
  };
  const MeshData cube = kuhn_cube(7, 1.8, 1);
  CHECK(notes(cube, "log(untangle{})") == "1 1");
  CHECK(notes(cube, "log(untangle{share = 0.9})") == "0 0");
  CHECK(notes(cube, "log(untangle{at_least = 10000})") == "0 0");
  CHECK(notes(cube, "smooth{} log(untangle{share = 0.9})") == "0 0");
}

TEST_CASE("every schedule but that of a table of the paper mends a tangled mesh") {
  for (const std::string name : {"shell", "conservative", "stellar", "grummp", "polish", "quick"}) {
    CAPTURE(name);
    TetMesh mesh(kuhn_cube(7, 1.8, 1));
    Run run(mesh, kRegistry);
    improve(run, Schedule::builtin(name));
    CHECK(count_not_positive(mesh) == 0);
    CHECK(run.records.at(0).name == "untangle");
    CHECK(static_cast<double>(mesh.tet_count()) < 1.1 * 6 * 343);
  }
}
