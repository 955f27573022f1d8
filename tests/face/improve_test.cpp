// SPDX-License-Identifier: MIT
// The one verb: what it gives, what it leaves as it was, how it ends.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tetmend/improve.h>
#include <tetmend/measure.h>

#include "contract/zoo.h"
#include "face/mesh_access.h"
#include "face/worse.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/mesh_view.h"
#include "schedule/schedule.h"
#include "tests/face/meshes.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/turned_ring.h"

using namespace tetmend;
using namespace tetmend::contract;
using namespace tetmend::test;

namespace {

const std::string kForever = "smooth{} while true do end";

bool equal(const Mesh& a, const Mesh& b) {
  return a.arrays().points == b.arrays().points && a.arrays().tets == b.arrays().tets &&
         a.arrays().tet_labels == b.arrays().tet_labels &&
         a.arrays().triangles == b.arrays().triangles;
}

/// With one of each kind of element. A mirrored one lists all tets the other way round.
Mesh turned_mesh(bool mirrored) {
  MeshArrays arrays;
  const MeshData ring = turned_ring();
  for (const Point& p : ring.points) arrays.points.push_back({p.x(), p.y(), p.z()});
  arrays.point_labels = {1, 2, 3, 4, 5, 6, 7, 8};
  for (const MeshData::Tet& tet : ring.tets) arrays.tets.push_back(tet.vertices);
  for (auto& tet : arrays.tets) {
    if (mirrored) std::swap(tet[0], tet[1]);
  }
  arrays.tet_labels = {3, 4, 5, 3, 4, 5, 3, 4};
  arrays.triangles = {{1, 2, 3}};
  arrays.edges = {{0, 1}};
  arrays.required_vertices = {4};
  return Mesh(arrays);
}

}  // namespace

TEST_CASE("improving gives the same mesh as the layers below, for any number of threads") {
  for (const std::string name : {"sheet.mesh", "two_materials.mesh"}) {
    CAPTURE(name);
    TetMesh plain = TetMesh::sorted(read_mesh(asset(name)));
    plain.set_bounds(Bounds::of(plain, Bounds::Holding::solver));
    Registry registry = Registry::builtin();
    Run run(plain, registry);
    run.set_most_tets(plain.tet_count() * 115 / 100);
    improve(run);
    const TempFolder folder;
    write_mesh(folder / "plain.meshb", MeshView(plain));
    for (const int threads : {1, 2, 5}) {
      Mesh mesh = load(asset(name));
      improve(mesh, {.threads = threads});
      save(folder / "face.meshb", mesh);
      CHECK(read_text(folder / "face.meshb") == read_text(folder / "plain.meshb"));
    }
  }
}

TEST_CASE("the result tells what the mesh was, what it is, and what was done") {
  Mesh mesh = load(asset("two_materials.mesh"));
  const Measurement before = measure(mesh);
  const Result result = improve(mesh, {.set = {{"max_rounds", "2"}}, .limit = true});
  const Measurement after = measure(mesh);
  CHECK(result.before.theta_min == before.statistics.theta_min);
  CHECK(result.before.n_bad == before.statistics.n_bad);
  CHECK(result.after.tets == mesh.tet_count());
  CHECK(result.after.theta_min == after.statistics.theta_min);
  CHECK(result.after.n_bad < result.before.n_bad);
  CHECK(result.ending == Ending::finished);
  CHECK(result.build.constrained_faces == before.build.constrained_faces);
  CHECK(result.volume_change() < 1e-12);
  CHECK(result.not_positive_after == 0);
  CHECK(result.protected_tets == 0);
  CHECK(result.touched_tets > 0);
  REQUIRE(result.limit);
  CHECK(result.limit->n_bad == result.after.n_bad);
  REQUIRE(!result.passes.empty());
  CHECK(result.passes.back().round == 2);
  CHECK(result.passes.back().after.n_bad == result.after.n_bad);
  for (const Pass& pass : result.passes) {
    CHECK(!pass.name.empty());
    CHECK(pass.accepted() <= pass.attempts());
  }
  CHECK(mesh.file().empty());
}

TEST_CASE("maps lead from old vertices and tets to new ones") {
  const Mesh old = load(asset("bracket.meshb"));
  Mesh mesh = old;
  const Result result = improve(mesh);
  REQUIRE(result.vertex_map.size() == old.point_count());
  REQUIRE(result.tet_map.size() == old.tet_count());

  // Vertices that stay are the first of the new mesh, in their order.
  std::uint32_t next = 0;
  for (const std::uint32_t v : result.vertex_map) {
    if (v != kGone) CHECK(v == next++);
  }
  CHECK(next < old.point_count());
  CHECK(next <= mesh.point_count());
  // Those of the surface have the same bits.
  for (const auto& triangle : old.triangles()) {
    for (const std::uint32_t v : triangle) {
      REQUIRE(result.vertex_map[v] != kGone);
      CHECK(mesh.points()[result.vertex_map[v]] == old.points()[v]);
    }
  }

  std::set<std::uint32_t> kept;
  std::size_t touched = 0;
  for (std::size_t t = 0; t < old.tet_count(); ++t) {
    if (result.tet_map[t] == kGone) continue;
    CHECK(kept.insert(result.tet_map[t]).second);
    std::array<std::uint32_t, 4> corners = old.tets()[t];
    std::array<std::uint32_t, 4> now = mesh.tets()[result.tet_map[t]];
    bool moved = false;
    for (std::uint32_t& v : corners) {
      const auto point = old.points()[v];
      v = result.vertex_map[v];
      REQUIRE(v != kGone);
      moved = moved || mesh.points()[v] != point;
    }
    CHECK(old.tet_labels()[t] == mesh.tet_labels()[result.tet_map[t]]);
    touched += moved;
    std::sort(corners.begin(), corners.end());
    std::sort(now.begin(), now.end());
    CHECK(corners == now);
  }
  CHECK(!kept.empty());
  CHECK(kept.size() < old.tet_count());
  CHECK(touched > 0);
  // A vertex may have moved there and back.
  CHECK(result.touched_tets >= touched + (mesh.tet_count() - kept.size()));
}

TEST_CASE("a mesh that nothing is done to keeps all its vertices and tets") {
  const Mesh old = load(asset("sheet.mesh"));
  Mesh mesh = old;
  const Result result = improve(mesh, {.script = "log 'nothing to do'"});
  REQUIRE(result.notes.size() == 2);
  CHECK(result.notes[0] == "nothing to do");
  CHECK(result.notes[1].starts_with("94 named inner triangles hold "));
  CHECK(result.touched_tets == 0);
  for (std::uint32_t v = 0; v < old.point_count(); ++v) CHECK(result.vertex_map[v] == v);
  for (std::size_t t = 0; t < old.tet_count(); ++t) {
    CHECK(mesh.tets()[result.tet_map[t]] == old.tets()[t]);
  }
  REQUIRE((result.rulers_before && result.rulers_after));
  CHECK((*result.rulers_before)[Ruler::sige].mean > 0);
  CHECK((*result.rulers_after)[Ruler::sige].mean == (*result.rulers_before)[Ruler::sige].mean);
  const Result again = improve(mesh, {.script = "log 'again'", .rulers = false, .maps = false});
  CHECK(again.vertex_map.empty());
  CHECK((!again.rulers_before && !again.rulers_after));
}

TEST_CASE("a mesh of broken topology is told with its place and stays as it was") {
  for (const bool mirrored : {false, true}) {
    CAPTURE(mirrored);
    const Mesh old = turned_mesh(mirrored);
    Mesh mesh = old;
    CHECK(message_of([&] { improve(mesh); }) ==
          (mirrored
               ? "tet 5 (vertices 6 5 7 1) and tet 4 (vertices 5 4 6 7) lie on the same side of "
                 "their common face, counted from 0"
               : "tet 5 (vertices 5 6 7 1) and tet 4 (vertices 4 5 6 7) lie on the same side of "
                 "their common face, counted from 0"));
    CHECK(equal(mesh, old));
    CHECK(mesh.arrays().point_labels == old.arrays().point_labels);
    CHECK(mesh.arrays().edges == old.arrays().edges);
    CHECK(mesh.arrays().required_vertices == old.arrays().required_vertices);
  }
}

TEST_CASE("a mesh of broken topology from a file is told with its line, as often as one asks") {
  const TempFolder folder;
  const auto file = folder / "a.mesh";
  save(file, turned_mesh(false));
  const std::string text = read_text(file);
  const auto line =
      1 + std::count(text.begin(),
                     text.begin() + static_cast<std::ptrdiff_t>(text.find("\n6 7 8 2 5\n") + 1),
                     '\n');
  Mesh mesh = load(file);
  for (int i = 0; i < 2; ++i) {
    CHECK(message_of([&] { improve(mesh); })
              .starts_with(
                  fmt::format("{}:{}: tet 6 (vertices 6 7 8 2) and tet 5 ", file.string(), line)));
  }
  mesh = Mesh();
  CHECK(message_of([&] { improve(mesh); }) == "the mesh has no tetrahedra");
}

TEST_CASE("a wrong option is named, and the mesh stays as it was") {
  const TempFolder folder;
  const Mesh old = load(asset("two_materials.mesh"));
  const std::vector<std::pair<std::string, Options>> wrong = {
      {"schedule", {.schedule = "varnish"}},
      {"set", {.set = {{"polish", "1"}}}},
      {"set", {.set = {{"max_rounds", "many"}}}},
      {"threads", {.threads = 0}},
      {"threads", {.threads = 1025}},
      {"time_limit", {.time_limit = -1}},
      {"protect", {.protect = {"lable:1"}}},
      {"only", {.only = {"box:0,0,0,1"}}},
      {"trace_operator", {.trace_operator = {"polish"}}},
      {"trace_around", {.trace_around = "here"}},
      {"trace_around", {.trace_around = "1"}},
      {"trace_operator", {.trace_operator = {"shell_transformation"}}},
      {"trace_piece", {.trace_piece = "1:0"}},
      {"trace_piece", {.trace = folder / "no.trace", .trace_piece = "first"}},
      {"trace_depth", {.trace_depth = 0}},
      {"trace_limit", {.trace_limit = 1000000}},
      {"feature_angle", {.feature_angle = 30}}};
  const std::vector<std::pair<std::string, Options>> wrong_for_this_mesh = {
      {"protect", {.protect = {"label:99"}}},
      {"only", {.only = {"box:90,90,90,91,91,91"}}},
      {"trace_around", {.trace = folder / "no.trace", .trace_around = "1000000"}}};
  const auto check_error = [](const std::string& name, const auto& call) {
    try {
      call();
      FAIL("no error");
    } catch (const OptionError& error) {
      CHECK(error.option() == name);
      CHECK(std::string(error.what()).starts_with(name));
    }
  };
  for (const auto& entry : wrong) {
    const std::string& name = entry.first;
    const Options& options = entry.second;
    CAPTURE(name);
    Mesh mesh = old;
    check_error(name, [&] { improve(mesh, options); });
    check_error(name, [&] { check(options); });
    CHECK(equal(mesh, old));
  }
  for (const auto& entry : wrong_for_this_mesh) {
    const std::string& name = entry.first;
    const Options& options = entry.second;
    CAPTURE(name);
    Mesh mesh = old;
    check_error(name, [&] { improve(mesh, options); });
    check(options);
    CHECK(equal(mesh, old));
    CHECK(mesh.file() == old.file());
  }
  check({.schedule = "thorough", .set = {{"max_rounds", "2"}}, .time_limit = 60});
}

TEST_CASE("a mistake in a script has its line, and the mesh is sound and improved so far") {
  Mesh mesh = load(asset("sheet.mesh"));
  const std::size_t bad = measure(mesh).statistics.n_bad;
  CHECK(message_of([&] {
          improve(mesh, {.script = "local_reconnection{}\nsmoth{}"});
        }).starts_with("script:2: unknown name 'smoth'"));
  CHECK(measure(mesh).statistics.n_bad < bad);
  const TempFolder folder;
  const std::string file = (folder / "my.lua").string();
  CHECK(message_of([&] { improve(mesh, {.schedule = file}); }).starts_with(file));
  write_text(file, "smooth{");
  CHECK(message_of([&] { improve(mesh, {.schedule = file}); }).starts_with(file + ":1: "));
}

TEST_CASE("what fell for mended inverted tets is named, and is no reason to go back") {
  Result result;
  const auto edge_ratio = [](std::optional<MeshRulers>& rulers) -> double& {
    return rulers->figures[static_cast<std::size_t>(Ruler::edge_ratio)].worst;
  };
  result.rulers_before.emplace();
  result.rulers_after.emplace();
  result.before.theta_min = 0.1;
  result.after.theta_min = 0.05;
  result.before.theta_max = 160;
  result.after.theta_max = 170;
  edge_ratio(result.rulers_before) = 7.4;
  edge_ratio(result.rulers_after) = 10.1;
  result.not_positive_before = result.not_positive_after = 5;
  const std::vector<std::string> all = {"a theta_min of 0.05 instead of 0.1",
                                        "a theta_max of 170 instead of 160",
                                        "a worst edge ratio of 10.1 instead of 7.4"};
  CHECK(result.worse() == all);
  CHECK(face::worse_for_nothing(result) == all);
  result.not_positive_after = 4;
  CHECK(result.worse() == all);
  CHECK(face::worse_for_nothing(result).empty());
  result.after.n_bad = result.before.n_bad + 1;
  CHECK(result.worse().size() == 4);
  CHECK(face::worse_for_nothing(result).size() == 1);
}

namespace {

/// Waves on a box whose vertices, those on its sides as well, are moved until tets turn over.
MeshData waves(unsigned cells, double jitter, unsigned seed) {
  MeshData data = kuhn_cube(cells, 0, 1);
  std::mt19937 random(seed);
  for (Point& p : data.points) {
    Point q = cells * p;
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] > 0.01 && p[axis] < 0.99)
        q[axis] += jitter * (static_cast<double>(random()) / 2147483648.0 - 1);
    }
    q.z() += 0.3 * std::sin(q.x()) * std::cos(0.7 * q.y());
    p = q;
  }
  return data;
}

/// Runs of the schedule that improving makes, until it is stopped at the beginning of the `last`-th.
Result improve_in_runs(Mesh& mesh, int last, int& runs) {
  Stage stage = Stage::building;
  runs = 0;
  return improve(mesh, {.progress = [&](const Progress& progress) {
                   if (progress.stage == Stage::improving && stage != Stage::improving) ++runs;
                   stage = progress.stage;
                   return runs < last;
                 }});
}

}  // namespace

TEST_CASE("a tangled mesh ends with no worse angle or edge ratio, or the report names it") {
  const auto improved = [](unsigned cells, double jitter, unsigned seed) {
    Mesh mesh = MeshAccess::make(waves(cells, jitter, seed));
    Result result = improve(mesh);
    CHECK(result.not_positive_after < result.not_positive_before);
    const auto edge_ratio = [](const std::optional<MeshRulers>& rulers) {
      return (*rulers)[Ruler::edge_ratio].worst;
    };
    const bool is_worse =
        result.after.theta_min < result.before.theta_min - 1e-9 ||
        result.after.theta_max > std::max(result.before.theta_max, 150.0) + 1e-9 ||
        edge_ratio(result.rulers_after) > std::max(edge_ratio(result.rulers_before), 10.0) + 1e-9;
    CHECK(is_worse == !result.worse().empty());
    return result;
  };
  CHECK(improved(3, 0.45, 4).worse().empty());  // edge ratio, unless held
  CHECK(improved(4, 0.5, 3).worse().empty());   // angles, unless each step holds them
  CHECK_FALSE(improved(4, 0.5, 5).worse().empty());
}

TEST_CASE("who stops the second run on a tangled mesh gets what the first one made") {
  constexpr int kNever = 100;
  int found = 0;
  for (unsigned seed = 1; seed <= 40 && found < 2; ++seed) {
    const MeshData tangled = waves(4, 0.5, seed);
    Mesh whole = MeshAccess::make(tangled);
    int runs = 0;
    const Result first = improve_in_runs(whole, kNever, runs);
    // A second run was made, which did not do better, and nothing else was worse.
    if (runs != 2 || first.worse().empty()) continue;
    ++found;
    CAPTURE(seed);
    Mesh mesh = MeshAccess::make(tangled);
    const Result stopped = improve_in_runs(mesh, 2, runs);
    CHECK(runs == 2);
    CHECK(stopped.ending == Ending::cancelled);
    CHECK(stopped.worse() == first.worse());
    CHECK(stopped.not_positive_after == first.not_positive_after);
    CHECK(equal(mesh, whole));
  }
  CHECK(found > 0);
}

TEST_CASE("what is worse than before is one list: promised figures, then aims") {
  Result result;
  result.rulers_before.emplace();
  result.rulers_after.emplace();
  result.rulers_before->figures[static_cast<std::size_t>(Ruler::radius_ratio)].mean = 0.7;
  result.rulers_after->figures[static_cast<std::size_t>(Ruler::radius_ratio)].mean = 0.6;
  const std::string aim = "a mean radius ratio of 0.6 instead of 0.7";
  CHECK(result.worse().empty());
  CHECK(result.missed_aims() == std::vector{aim});
  CHECK(result.worse_than_before() == std::vector{aim});
  result.before.lambda = 1;
  result.after.lambda = 2;
  CHECK(result.worse_than_before() == std::vector{std::string("a lambda of 2 instead of 1"), aim});
  // As many digits as tell them apart.
  result.rulers_after->figures[static_cast<std::size_t>(Ruler::radius_ratio)].mean = 0.699999;
  CHECK(result.missed_aims() ==
        std::vector{std::string("a mean radius ratio of 0.699999 instead of 0.7")});
}

TEST_CASE("a run that ends with a worse figure goes back to the best of its passes, and says so") {
  // Flat boxes: all tets are bad, and more vertices make more of them.
  MeshData data = kuhn_cube(4, 0.1, 1);
  for (Point& p : data.points) p.z() *= 0.15;
  const TempFolder folder;
  write_mesh(folder / "flat.mesh", MeshView(TetMesh(data)));
  const std::string spoil =
      "judge_by{measure = 'sine', price = 0} "
      "for _ = 1, 3 do apply({'centroid_insertion', desperate = 2}, {on = 'all'}) end";
  const auto improved = [&](const std::string& script) {
    Mesh mesh = load(folder / "flat.mesh");
    const Result result = improve(mesh, {.script = script, .layers = Layers::improve});
    CHECK(result.worse().empty());
    CHECK(result.after.tets == mesh.tet_count());
    return std::pair(result, mesh);
  };
  const auto went_back = [](const Result& result, const std::string& where) {
    return std::any_of(result.notes.begin(), result.notes.end(), [&](const std::string& note) {
      return note.starts_with("went back to the state after pass " + where +
                              ": at the end there was ");
    });
  };
  const auto good = improved("local_reconnection{}");
  CHECK(good.first.passes.size() == 1);
  CHECK_FALSE(went_back(good.first, "1 of 1"));
  const auto back = improved("local_reconnection{} " + spoil);
  CHECK(equal(back.second, good.second));
  CHECK(back.first.passes.size() == 1);
  CHECK(went_back(back.first, "1 of 4"));
  const auto none = improved(spoil);
  CHECK(equal(none.second, improved("log('nothing')").second));
  CHECK(none.first.passes.empty());
  CHECK(went_back(none.first, "0 of 3"));
}

TEST_CASE("a time limit holds for the way back, too") {
  MeshData data = kuhn_cube(4, 0.1, 1);
  for (Point& p : data.points) p.z() *= 0.15;
  Mesh mesh = MeshAccess::make(std::move(data));
  const std::string spoil =
      "local_reconnection{} smooth{} judge_by{measure = 'sine', price = 0} "
      "for _ = 1, 3 do apply({'centroid_insertion', desperate = 2}, {on = 'all'}) end";
  constexpr double kSeconds = 3;  // the first run takes far less
  bool has_slept = false;
  Stage stage = Stage::building;
  int runs = 0;
  const Result result = improve(
      mesh, {.script = spoil,
             .time_limit = kSeconds,
             .layers = Layers::improve,
             .progress = [&](const Progress& progress) {
               if (progress.stage == Stage::improving && stage != Stage::improving) ++runs;
               stage = progress.stage;
               if (runs == 2 && progress.phase == "smooth" && !std::exchange(has_slept, true)) {
                 std::this_thread::sleep_for(std::chrono::duration<double>(kSeconds));
               }
               return true;
             }});
  CHECK(runs == 2);
  CHECK(std::any_of(result.notes.begin(), result.notes.end(), [](const std::string& note) {
    return note.ends_with("; it was stopped on the way to pass 2");
  }));
  CHECK(result.worse().empty());
}

TEST_CASE(
    "who stops a run that goes back gets what it has reached on the way, and the note says so") {
  MeshData data = kuhn_cube(4, 0.1, 1);
  for (Point& p : data.points) p.z() *= 0.15;
  const Mesh flat = MeshAccess::make(std::move(data));
  const std::string spoil =
      "local_reconnection{} smooth{} judge_by{measure = 'sine', price = 0} "
      "for _ = 1, 3 do apply({'centroid_insertion', desperate = 2}, {on = 'all'}) end";
  Mesh mesh = flat;
  Stage stage = Stage::building;
  int runs = 0;
  const Result result = improve(
      mesh, {.script = spoil, .layers = Layers::improve, .progress = [&](const Progress& progress) {
               if (progress.stage == Stage::improving && stage != Stage::improving) ++runs;
               stage = progress.stage;
               return runs < 2 || progress.phase != "smooth";
             }});
  CHECK(runs == 2);
  CHECK(result.ending == Ending::cancelled);
  CHECK(result.worse().empty());
  CHECK_FALSE(result.passes.empty());
  CHECK(result.after.tets == mesh.tet_count());
  CHECK(result.after.n_bad == measure(mesh).statistics.n_bad);
  CHECK_FALSE(equal(mesh, flat));
  CHECK(std::any_of(result.notes.begin(), result.notes.end(), [](const std::string& note) {
    return note.starts_with("went back to the state after pass ") &&
           note.ends_with("; it was stopped on the way to pass 2");
  }));
}

TEST_CASE("a run tells how far it has come: stages, passes, notes") {
  Mesh mesh = load(asset("sheet.mesh"));
  std::vector<Stage> stages;
  std::set<std::string> phases;
  std::vector<std::string> notes;
  std::size_t bad = 0;
  const Result result =
      improve(mesh, {.script = "smooth{} log('half') local_reconnection{}",
                     .threads = 2,
                     .progress =
                         [&](const Progress& progress) {
                           if (stages.empty() || stages.back() != progress.stage) {
                             stages.push_back(progress.stage);
                           }
                           if (progress.stage == Stage::improving) {
                             phases.emplace(progress.phase);
                             bad = progress.now.n_bad;
                           }
                           CHECK(progress.share >= 0);
                           CHECK(progress.share <= 1);
                           return true;
                         },
                     .note = [&](std::string_view text) { notes.emplace_back(text); }});
  CHECK(stages ==
        std::vector{Stage::building, Stage::measuring, Stage::improving, Stage::measuring});
  for (const Pass& pass : result.passes) CHECK(phases.contains(pass.name));
  REQUIRE(!notes.empty());
  CHECK(notes[0] == "half");
  CHECK(notes == result.notes);
  CHECK(bad == result.after.n_bad);
}

TEST_CASE("a run stops when progress says so, when a flag is set, and when its time is over") {
  const Mesh old = load(asset("sheet.mesh"));
  const auto ending_of = [&](Options options) {
    Mesh mesh = old;
    options.script = kForever;
    const Ending ending = improve(mesh, options).ending;
    CHECK(measure(mesh).statistics.tets == mesh.tet_count());
    return ending;
  };
  CHECK(ending_of({.progress = [](const Progress& p) { return p.stage != Stage::improving; }}) ==
        Ending::cancelled);
  CHECK(ending_of({.progress = [](const Progress& p) { return p.stage != Stage::building; }}) ==
        Ending::cancelled);
  CHECK(ending_of({.time_limit = 0.05}) == Ending::time_limit);
  std::atomic<bool> flag = false;
  CHECK(ending_of({.progress =
                       [&](const Progress& p) {
                         if (p.stage == Stage::improving) flag = true;
                         return true;
                       },
                   .cancel = &flag}) == Ending::cancelled);
}

TEST_CASE("an exception of a user's function ends the run, and comes out of it") {
  for (const int threads : {1, 3}) {
    Mesh mesh = load(asset("bracket.meshb"));
    const auto fail = [](const Progress& progress) -> bool {
      if (progress.stage == Stage::improving && progress.share > 0) {
        throw std::runtime_error("no more");
      }
      return true;
    };
    CHECK_THROWS_WITH_AS(improve(mesh, {.threads = threads, .progress = fail}), "no more",
                         std::runtime_error);
    CHECK(measure(mesh).statistics.tets == mesh.tet_count());
  }
}

TEST_CASE("two threads improve a mesh each at the same time") {
  const auto work = [](Mesh& mesh, int threads) {
    mesh = load(asset("sheet.mesh"));
    improve(mesh, {.threads = threads});
  };
  Mesh a;
  Mesh b;
  Mesh alone;
  std::thread first([&] { work(a, 2); });
  std::thread second([&] { work(b, 1); });
  first.join();
  second.join();
  work(alone, 1);
  CHECK(equal(a, alone));
  CHECK(equal(b, alone));
}

TEST_CASE("a run that nobody asks for rulers keeps to them, too: its mesh is the same") {
  Mesh with = load(TETMEND_SOURCE_DIR "/tests/face/inverted_at_labels.mesh");
  Mesh without = with;
  Options options;
  options.keep_size = true;
  options.measure = "sine";
  const Result result = improve(with, options);
  CHECK(result.rulers_after.has_value());
  // Without rulers nobody would see it.
  const auto told =
      std::find_if(result.notes.begin(), result.notes.end(),
                   [](const std::string& note) { return note.starts_with("went back"); });
  REQUIRE(told != result.notes.end());
  CHECK(told->find("a worst mean ratio") != std::string::npos);
  // Nor does all go: half as many passes as left the fewest bad tets break no bound.
  CHECK_FALSE(told->starts_with("went back to the state after pass 0 "));
  CHECK_FALSE(result.passes.empty());
  CHECK(result.after.n_bad < result.before.n_bad);
  options.rulers = false;
  CHECK_FALSE(improve(without, options).rulers_after.has_value());
  CHECK(equal(with, without));
}
