// SPDX-License-Identifier: MIT
// The whole schedule: better meshes, the same every time, with an end.
#include "schedule/schedule.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/formats/mesh_io.h"
#include "kernel/integrity.h"
#include "kernel/wanted_lengths.h"
#include "tests/support/assets.h"
#include "tests/support/registry.h"
#include "tests/support/renumbered.h"
#include "tests/support/stopper.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Coordinates of the boundary and constrained faces, in an order that does not depend on handles.
std::vector<std::vector<double>> surface(const TetMesh& mesh) {
  std::vector<std::vector<double>> faces;
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned f = 0; f < 4; ++f) {
      if (!mesh.is_boundary(HalfFace(t, f)) && !mesh.is_constrained(HalfFace(t, f))) continue;
      std::vector<double> numbers;
      auto corners = mesh.vertices(HalfFace(t, f));
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      for (const VertexHandle v : corners) {
        for (int k = 0; k < 3; ++k) numbers.push_back(mesh.point(v)[k]);
      }
      numbers.push_back(mesh.label(t));
      faces.push_back(std::move(numbers));
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace

TEST_CASE("meshes full of slivers come out with few bad tets, the surface untouched") {
  for (const std::string file : {"two_materials.mesh", "sheet.mesh", "bracket.meshb"}) {
    CAPTURE(file);
    TetMesh mesh(read_mesh(asset(file)));
    const MeshStatistics before = compute_statistics(mesh);
    const auto surface_before = surface(mesh);
    Run run(mesh, kRegistry);
    improve(run);
    const MeshStatistics now = compute_statistics(mesh);
    MESSAGE(file, ": theta ", before.theta_min, " to ", before.theta_max, ", lambda ",
            before.lambda, " % -> ", now.theta_min, " to ", now.theta_max, ", ", now.lambda,
            " %, rounds ", run.round);
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(count_not_positive(mesh) == 0);
    CHECK(surface(mesh) == surface_before);
    CHECK(now.volume == doctest::Approx(before.volume).epsilon(1e-12));
    CHECK(now.lambda < 0.2 * before.lambda);
    CHECK(now.theta_min > 10);
    CHECK(now.theta_max < 165);
    CHECK(now.tets < 1.3 * static_cast<double>(before.tets));
  }
}

TEST_CASE("the same mesh improved twice from the start gives the same bits") {
  for (const char* file : {"two_materials.mesh", "sheet.mesh"}) {
    TetMesh first(read_mesh(asset(file)));
    TetMesh second(read_mesh(asset(file)));
    Run one(first, kRegistry);
    Run two(second, kRegistry);
    improve(one);
    improve(two);
    CHECK(first == second);
    CHECK(one.records.size() == two.records.size());
  }
}

TEST_CASE("a second improvement of the result changes little") {
  TetMesh mesh(read_mesh(asset("two_materials.mesh")));
  Run first(mesh, kRegistry);
  improve(first);
  const MeshStatistics once = compute_statistics(mesh);
  Run second(mesh, kRegistry);
  improve(second);
  const MeshStatistics twice = compute_statistics(mesh);
  CHECK(twice.q_worst >= once.q_worst);
  CHECK(std::abs(static_cast<double>(twice.tets) - static_cast<double>(once.tets)) <
        0.03 * static_cast<double>(once.tets));
  CHECK(std::abs(twice.lambda - once.lambda) < 0.3);
}

TEST_CASE("a run that is cancelled before it begins does nothing") {
  TetMesh mesh(read_mesh(asset("two_materials.mesh")));
  const TetMesh before = mesh;
  const std::atomic<bool> cancel = true;
  Run run(mesh, kRegistry);
  run.set_cancel_flag(&cancel);
  improve(run);
  CHECK(run.records.empty());
  CHECK(mesh == before);
}

TEST_CASE("a run that is cancelled on its way stops soon with a sound and no worse mesh") {
  for (const int reports : {1, 3, 6, 12}) {
    TetMesh mesh(read_mesh(asset("two_materials.mesh")));
    const auto surface_before = surface(mesh);
    const double q_worst = quality_indicators(mesh).q_worst;
    Stopper stopper(reports);
    Run run(mesh, kRegistry);
    run.set_listener(&stopper);
    run.set_cancel_flag(&stopper.cancel);
    improve(run);
    CHECK(stopper.cancel);
    CHECK(stopper.left <= 0);
    CHECK(stopper.left >= -6);  // the other passes of the round report once each, at most
    CHECK(run.round <= 2);
    CHECK(stopper.passes == static_cast<int>(run.records.size()));
    CHECK(check_integrity(mesh).empty());
    CHECK(surface(mesh) == surface_before);
    CHECK(quality_indicators(mesh).q_worst >= q_worst);
  }
}

TEST_CASE("a mesh without bad tets comes back as it is") {
  TetMesh mesh(kuhn_cube(3, 0, 1));
  const TetMesh before = mesh;
  Run run(mesh, kRegistry);
  improve(run);
  CHECK(run.records.empty());
  CHECK(mesh == before);
}

TEST_CASE("every mesh of the zoo comes to an end, sound and no worse, with the same surface") {
  for (const NamedMesh& named : zoo()) {
    CAPTURE(named.name);
    TetMesh mesh(named.data);
    const auto surface_before = surface(mesh);
    const QualityIndicators before = quality_indicators(mesh);
    const std::size_t not_positive = count_not_positive(mesh);
    Run run(mesh, kRegistry);
    improve(run);
    CHECK(run.round < 30);
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(surface(mesh) == surface_before);
    CHECK(quality_indicators(mesh).q_worst >= before.q_worst);
    CHECK(count_not_positive(mesh) <= not_positive);
    CHECK_NOTHROW(TetMesh(mesh.to_data()));
  }
}

TEST_CASE("inverted and flat tets turn positive") {
  for (const char* name : {"inverted_tet", "flat_tet", "tangled_ball_60", "folded_cube_4"}) {
    CAPTURE(name);
    TetMesh mesh(zoo_data(name));
    const std::size_t before = count_not_positive(mesh);
    REQUIRE(before > 0);
    Run run(mesh, kRegistry);
    improve(run);
    CHECK(count_not_positive(mesh) < before);
  }
}

TEST_CASE("a mesh whose tets are all bad and all on the boundary comes to an end") {
  MeshData data;
  data.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0.05}};
  data.tets = {{{0, 1, 2, 4}}, {{0, 2, 3, 4}}};
  TetMesh mesh(data);
  const TetMesh before = mesh;
  Run run(mesh, kRegistry);
  improve(run);
  CHECK(mesh == before);
  CHECK(run.round <= 5);
}

TEST_CASE("every builtin schedule improves a mesh, keeps its surface and ends") {
  for (const std::string_view name : builtin_schedule_names()) {
    CAPTURE(name);
    const Schedule schedule = Schedule::builtin(name);
    CHECK(schedule.describe().description.size() > 20);
    for (const ScheduleParameter& parameter : schedule.describe().parameters) {
      CHECK(parameter.help.size() > 5);
    }
    TetMesh mesh(read_mesh(asset("two_materials.mesh")));
    const auto surface_before = surface(mesh);
    const MeshStatistics before = compute_statistics(mesh);
    // One that asks for lengths gets about those that there are.
    const double usual = std::cbrt(8.5 * before.volume / static_cast<double>(before.tets));
    if (name == "adapt") mesh.set_size_field(std::make_shared<WantedLengths>(usual));
    Run run(mesh, kRegistry);
    improve(run, schedule);
    const MeshStatistics now = compute_statistics(mesh);
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(surface(mesh) == surface_before);
    CHECK(now.q_worst >= before.q_worst);
    CHECK(2 * now.n_bad < before.n_bad);
    if (name == "conservative") CHECK(now.vertices == before.vertices);
  }
}

TEST_CASE("schedules are found by name and by file, and what is missing is named") {
  CHECK(Schedule::find("shell").name() == "shell");
  CHECK(Schedule::find((kSource / "assets/schedules/shell.lua").string()).text() ==
        Schedule::builtin("shell").text());
  const auto error_of = [](const std::string& name) {
    try {
      Schedule::find(name);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(error_of("varnish").starts_with("there is no schedule 'varnish': expected shell, "));
  CHECK(error_of("/nowhere/x.lua") == "/nowhere/x.lua: cannot read it");
}

TEST_CASE("no more rounds are done than allowed") {
  TetMesh mesh(read_mesh(asset("two_materials.mesh")));
  Run run(mesh, kRegistry);
  improve(run, Schedule::builtin("shell"), {{"max_rounds", "1"}});
  CHECK(run.round == 1);
}

TEST_CASE("thorough leaves better meshes than the default where the default leaves bad tets") {
  const MeshData folded = read_mesh(asset("folded_sheet.mesh"));
  const auto improved = [](const MeshData& data, const Schedule& schedule) {
    TetMesh mesh(data);
    const auto surface_before = surface(mesh);
    Run run(mesh, kRegistry);
    improve(run, schedule);
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(count_not_positive(mesh) == 0);
    CHECK(surface(mesh) == surface_before);
    return quality_indicators(mesh);
  };
  const Schedule plain = Schedule::builtin("shell");
  const Schedule thorough = Schedule::builtin("thorough");
  std::size_t n_bad = 0;
  std::size_t n_bad_of_plain = 0;
  double gain = 0;  // of the worst tet
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const MeshData copy = renumbered(folded, seed);
    const QualityIndicators of_plain = improved(copy, plain);
    const QualityIndicators now = improved(copy, thorough);
    CHECK(now.q_worst >= of_plain.q_worst - 1e-6);
    n_bad_of_plain += of_plain.n_bad;
    n_bad += now.n_bad;
    gain += now.q_worst - of_plain.q_worst;
  }
  // The folded surface forces nearly all of them.
  CHECK(n_bad <= n_bad_of_plain);
  CHECK(gain > 0);
}

TEST_CASE("thorough ends at its goal") {
  const auto rounds_to = [](double goal) {
    TetMesh mesh(read_mesh(asset("folded_sheet.mesh")));
    mesh.set_standard(Standard(Goal::symmetric(goal)));
    Run run(mesh, kRegistry);
    improve(run, Schedule::builtin("thorough"));
    return run.round;
  };
  CHECK(rounds_to(8) <= 1);
  CHECK(rounds_to(30) > 1);  // 30 degrees cannot be reached beside the folded sheet
}
