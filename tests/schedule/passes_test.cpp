// SPDX-License-Identifier: MIT
// Each pass on the project's own meshes and the zoo: the mesh gets no worse, what is fixed stays,
// nothing is tried twice.
#include "schedule/passes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/formats/mesh_io.h"
#include "kernel/integrity.h"
#include "tests/support/assets.h"
#include "tests/support/registry.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

struct NamedPass {
  std::string name;
  std::function<void(Run&)> work;
};

const std::vector<NamedPass> kPasses = {
    {"local_reconnection", [](Run& run) { local_reconnection(run, {}); }},
    {"smooth", [](Run& run) { smooth(run, {}); }},
    {"suppress_points", [](Run& run) { suppress_points(run, {}); }},
    {"insert_points", [](Run& run) { insert_points(run, {}); }},
};

using FaceVertices = std::array<VertexHandle, 3>;

/// What every pass keeps: the faces of boundary and constraints with their points, and the volume
/// of each region.
struct Kept {
  std::vector<std::tuple<FaceVertices, Label>> faces;
  std::vector<std::tuple<VertexHandle, double, double, double>> points;
  std::map<Label, long double> volumes;
  long double absolute = 0;
};

Kept kept(const TetMesh& mesh) {
  Kept k;
  for (const TetHandle t : live_tets(mesh)) {
    const TetVertices& v = mesh.vertices(t);
    const long double six =
        volume6(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
    k.volumes[mesh.label(t)] += six;
    k.absolute += std::abs(six);
    for (unsigned f = 0; f < 4; ++f) {
      if (!mesh.is_boundary(HalfFace(t, f)) && !mesh.is_constrained(HalfFace(t, f))) continue;
      FaceVertices face = mesh.vertices(HalfFace(t, f));
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      k.faces.emplace_back(face, mesh.label(t));
    }
  }
  for (const VertexHandle v : live_vertices(mesh)) {
    const Point& p = mesh.point(v);
    if (mesh.is_fixed(v)) k.points.emplace_back(v, p.x(), p.y(), p.z());
  }
  std::sort(k.faces.begin(), k.faces.end());
  return k;
}

/// Ascending, computed from the points.
std::vector<Quality> qualities_from_points(const TetMesh& mesh) {
  std::vector<Quality> all;
  for (const TetHandle t : live_tets(mesh)) all.push_back(mesh.evaluate(mesh.vertices(t)));
  std::sort(all.begin(), all.end());
  return all;
}

bool no_worse(std::vector<Quality> now, std::vector<Quality> before) {
  const std::size_t size = std::max(now.size(), before.size());
  now.resize(size, std::numeric_limits<Quality>::infinity());
  before.resize(size, std::numeric_limits<Quality>::infinity());
  return now >= before;
}

void check_surface_kept(const TetMesh& mesh, const Kept& before) {
  CHECK(to_string(check_integrity(mesh)) == "");
  const Kept now = kept(mesh);
  CHECK(now.faces == before.faces);
  CHECK(now.points == before.points);
  REQUIRE(now.volumes.size() == before.volumes.size());
  for (const auto& [label, volume] : before.volumes) {
    CHECK(std::abs(now.volumes.at(label) - volume) <= 1e-12L * before.absolute);
  }
}

/// Meshes of the project, then the zoo.
std::vector<NamedMesh> meshes_and_zoo(bool with_bracket) {
  std::vector<NamedMesh> all;
  for (const char* file : {"two_materials.mesh", "sheet.mesh", "bracket.meshb"}) {
    if (std::string(file) == "bracket.meshb" && !with_bracket) continue;
    all.push_back({file, read_mesh(asset(file))});
  }
  for (NamedMesh& mesh : zoo()) all.push_back(std::move(mesh));
  return all;
}

MeshData two_materials() {
  return read_mesh(asset("two_materials.mesh"));
}

}  // namespace

TEST_CASE("no pass lowers the quality vector or touches what is fixed") {
  for (const NamedMesh& named : meshes_and_zoo(true)) {
    CAPTURE(named.name);
    for (const NamedPass& pass : kPasses) {
      CAPTURE(pass.name);
      TetMesh mesh(named.data);
      const Kept before = kept(mesh);
      const auto vector = qualities_from_points(mesh);
      const std::size_t not_positive = count_not_positive(mesh);
      Run run(mesh, kRegistry);
      pass.work(run);
      check_surface_kept(mesh, before);
      CHECK(no_worse(qualities_from_points(mesh), vector));
      CHECK(count_not_positive(mesh) <= not_positive);
      REQUIRE(run.records.size() == 1);
      CHECK(run.records[0].name == pass.name);
      const bool changed = qualities_from_points(mesh) != vector;
      CHECK((run.records[0].accepted() > 0) == changed);
      CHECK(run.records[0].after.q_worst == doctest::Approx(qualities_from_points(mesh).front()));
    }
  }
}

TEST_CASE("on a mesh with many slivers each pass finds something to improve") {
  for (const NamedPass& pass : kPasses) {
    CAPTURE(pass.name);
    TetMesh mesh(two_materials());
    const QualityIndicators before = quality_indicators(mesh);
    Run run(mesh, kRegistry);
    pass.work(run);
    const QualityIndicators now = quality_indicators(mesh);
    CHECK(run.records[0].accepted() > 10);
    CHECK(now.q_worst >= before.q_worst);
    // Only reconnection lowers the number of bad tets for sure: the others raise the worst, at the
    // expense of good ones.
    if (pass.name == "local_reconnection") CHECK(2 * now.n_bad < before.n_bad);
  }
}

TEST_CASE("passes one after the other keep what is fixed") {
  for (const NamedMesh& named : meshes_and_zoo(false)) {
    CAPTURE(named.name);
    TetMesh mesh(named.data);
    const Kept before = kept(mesh);
    Run run(mesh, kRegistry);
    double q_worst = quality_indicators(mesh).q_worst;
    for (int round = 0; round < 2; ++round) {
      for (const NamedPass& pass : kPasses) {
        pass.work(run);
        CHECK(quality_indicators(mesh).q_worst >= q_worst);
        q_worst = quality_indicators(mesh).q_worst;
      }
    }
    check_surface_kept(mesh, before);
  }
}

TEST_CASE("every triangle of a sheet inside the volume survives each pass") {
  const MeshData data = read_mesh(asset("sheet.mesh"));
  const auto sheet = [](const TetMesh& mesh) {
    std::size_t count = 0;
    for (const TetHandle t : live_tets(mesh)) {
      for (unsigned f = 0; f < 4; ++f) count += mesh.is_constrained(HalfFace(t, f));
    }
    return count;
  };
  TetMesh mesh(data);
  REQUIRE(sheet(mesh) == 2 * 94);
  Run run(mesh, kRegistry);
  for (const NamedPass& pass : kPasses) {
    pass.work(run);
    CHECK(sheet(mesh) == 2 * 94);
    CHECK(mesh.to_data().triangles == data.triangles);
  }
}

TEST_CASE("a pass that has found nothing makes no attempt the next time") {
  for (const NamedPass& pass : kPasses) {
    CAPTURE(pass.name);
    TetMesh mesh(two_materials());
    Run run(mesh, kRegistry);
    for (int i = 0; i < 1000; ++i) {
      pass.work(run);
      if (run.records.back().accepted() == 0) break;
    }
    REQUIRE(run.records.back().accepted() == 0);
    const TetMesh before = mesh;
    pass.work(run);
    CHECK(run.records.back().attempts() == 0);
    CHECK(mesh == before);
  }
}

TEST_CASE("a pass with other settings tries what another has given up") {
  TetMesh mesh(two_materials());
  Run run(mesh, kRegistry);
  LocalReconnectionOptions plain;
  plain.edge_operator = "edge_removal";
  plain.sweeps = 20;
  local_reconnection(run, plain);
  local_reconnection(run, plain);
  CHECK(run.records.back().attempts() == 0);
  LocalReconnectionOptions other;
  local_reconnection(run, other);
  CHECK(run.records.back().accepted() > 0);
}

TEST_CASE("a mesh without bad tets gets no attempt") {
  for (const NamedPass& pass : kPasses) {
    TetMesh mesh(kuhn_cube(3, 0, 1));
    REQUIRE(quality_indicators(mesh).n_bad == 0);
    const TetMesh before = mesh;
    Run run(mesh, kRegistry);
    pass.work(run);
    CHECK(run.records[0].attempts() == 0);
    CHECK(mesh == before);
  }
}

TEST_CASE("a mesh whose bad tets have only fixed vertices and boundary edges is left alone") {
  MeshData data;  // a flat tent: four tets of which each face but those inside lies on the boundary
  data.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0.05}};
  data.tets = {{{0, 1, 2, 4}}, {{0, 2, 3, 4}}};
  for (const NamedPass& pass : kPasses) {
    TetMesh mesh(data);
    REQUIRE(quality_indicators(mesh).n_bad == 2);
    const TetMesh before = mesh;
    Run run(mesh, kRegistry);
    pass.work(run);
    CHECK(run.records[0].accepted() == 0);
    CHECK(mesh == before);
  }
}

TEST_CASE("a cancelled pass makes no attempt and leaves the mesh as it is") {
  for (const NamedPass& pass : kPasses) {
    TetMesh mesh(two_materials());
    const TetMesh before = mesh;
    Run run(mesh, kRegistry);
    const std::atomic<bool> cancel = true;
    run.set_cancel_flag(&cancel);
    pass.work(run);
    CHECK(run.records[0].attempts() == 0);
    CHECK(mesh == before);
  }
}

TEST_CASE("passes give the same mesh on every run") {
  for (const NamedPass& pass : kPasses) {
    TetMesh first(two_materials());
    TetMesh second(two_materials());
    Run one(first, kRegistry);
    Run two(second, kRegistry);
    pass.work(one);
    pass.work(two);
    CHECK(first == second);
    CHECK(one.records[0].verdicts == two.records[0].verdicts);
  }
}

TEST_CASE("an unknown operator or setting is an error before anything is tried") {
  TetMesh mesh(two_materials());
  const TetMesh before = mesh;
  Run run(mesh, kRegistry);
  LocalReconnectionOptions unknown;
  unknown.edge_operator = "edge_magic";
  CHECK_THROWS_AS(local_reconnection(run, unknown), Error);
  SmoothOptions smoothing;
  smoothing.settings = {{"magic", 1}};
  CHECK_THROWS_AS(smooth(run, smoothing), Error);
  CHECK(mesh == before);
}

TEST_CASE("reconnection works with edges alone, with faces alone and with neither") {
  for (const bool edges : {false, true}) {
    for (const bool faces : {false, true}) {
      TetMesh mesh(two_materials());
      Run run(mesh, kRegistry);
      LocalReconnectionOptions options;
      if (!edges) options.edge_operator.clear();
      if (!faces) options.face_operator.clear();
      local_reconnection(run, options);
      CHECK((run.records[0].accepted() > 0) == (edges || faces));
    }
  }
}

TEST_CASE(
    "progress is a better worst tet, noticeably fewer bad tets, or better ones among as many") {
  const QualityIndicators before = {0.1, 1000, 0.3};
  CHECK_FALSE(is_progress(before, before));
  CHECK(is_progress(before, {0.2, 1000, 0.3}));
  CHECK(is_progress(before, {0.2, 2000, 0.1}));
  CHECK_FALSE(is_progress(before, {0.1 + 1e-6, 1000, 0.3}));
  CHECK_FALSE(is_progress(before, {0.1, 999, 0.3}));
  CHECK(is_progress(before, {0.1, 900, 0.2}));
  CHECK(is_progress(before, {0.1, 1000, 0.35}));
  CHECK_FALSE(is_progress(before, {0.1, 1001, 0.35}));
  CHECK_FALSE(is_progress(before, {0.05, 1000, 0.3}));
  // Few bad tets: one less counts.
  CHECK(is_progress({0.1, 5, 0.3}, {0.1, 4, 0.3}));
  CHECK(is_progress({0.1, 1, 0.1}, {0.6, 0, 0}));
  CHECK_FALSE(is_progress({0.6, 0, 0}, {0.6, 0, 0}));
}

TEST_CASE("one reconnection pass: recursion beats no recursion and the classic operators") {
  std::vector<std::filesystem::path> files = {asset("bracket.meshb")};
  const std::filesystem::path tire = kSource / "../shared/meshes/tire.mesh";
  if (std::filesystem::exists(tire)) {
    files.push_back(tire);
  } else {
    MESSAGE("skipped: ", tire.string(), " is not here");
  }
  for (const auto& file : files) {
    CAPTURE(file.filename().string());
    const auto lambda = [&](const std::string& edge_operator, const ParameterSettings& settings) {
      TetMesh mesh(read_mesh(file));
      Run run(mesh, kRegistry);
      LocalReconnectionOptions options;
      options.edge_operator = edge_operator;
      options.edge_settings = settings;
      local_reconnection(run, options);
      return compute_statistics(mesh).lambda;
    };
    const double classic = lambda("edge_removal", {});
    const double level_0 = lambda("recursive_shell_transformation", {{"max_level", 0}});
    const double level_5 = lambda("recursive_shell_transformation", {{"max_level", 5}});
    MESSAGE(file.filename().string(), ": lambda ", classic, " % edge removal, ", level_0,
            " % max_level 0, ", level_5, " % max_level 5");
    CHECK(level_5 < level_0);
    CHECK(level_5 < classic);
  }
}

TEST_CASE(
    "a polish raises the mean ratio, and no tet falls below the goal or gets worse below it") {
  for (const char* name : {"folded_sheet.mesh", "two_materials.mesh"}) {
    CAPTURE(name);
    TetMesh mesh = TetMesh::sorted(read_mesh(asset(name)));
    Run run(mesh, kRegistry);
    local_reconnection(run);
    smooth(run);
    const Kept before = kept(mesh);
    const auto mean = [&] { return summarize(mesh, find_quality_measure("mean_ratio")).mean; };
    const auto bad_tets = [&] {
      std::vector<Quality> bad;
      for (const TetHandle t : live_tets(mesh)) {
        if (mesh.quality(t) < kBadThreshold) bad.push_back(mesh.quality(t));
      }
      std::sort(bad.begin(), bad.end());
      return bad;
    };
    const double mean_before = mean();
    const std::vector<Quality> bad_before = bad_tets();
    REQUIRE(bad_before.size() > 20);
    polish(run);
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(kept(mesh).faces == before.faces);
    CHECK(kept(mesh).points == before.points);
    CHECK(mean() > mean_before + 0.01);
    const std::vector<Quality> bad_now = bad_tets();
    REQUIRE(bad_now.size() <= bad_before.size());
    CHECK(bad_now.front() >= bad_before.front() - kQualityTolerance);
    // Where nothing is left to gain, nothing is done.
    polish(run, {.cycles = 30});
    const double reached = mean();
    polish(run, {.cycles = 1});
    CHECK(mean() == doctest::Approx(reached).epsilon(1e-3));
  }
}
