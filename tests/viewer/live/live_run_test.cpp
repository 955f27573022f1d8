// SPDX-License-Identifier: MIT
#include "viewer/live/live_run.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tetmend/improve.h>

#include "contract/zoo.h"
#include "face/mesh_access.h"
#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/integrity.h"
#include "kernel/surface_fingerprint.h"
#include "schedule/schedule.h"
#include "tests/face/meshes.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/layered_mesh.h"
#include "tests/support/second_order.h"
#include "tests/support/traced_run.h"
#include "tests/viewer/session.h"
#include "trace/trace_file.h"
#include "viewer/commands/script.h"
#include "viewer/overlay.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

namespace {

constexpr double kForever = 600;

LiveRun::Input measured(TetMesh mesh) {
  const MeshStatistics statistics = compute_statistics(mesh);
  return {std::move(mesh), statistics};
}

LiveRun::Input live_input(const std::string& name) {
  return measured(
      TetMesh(read_mesh(std::filesystem::path(TETMEND_SOURCE_DIR) / "assets/meshes" / name)));
}

/// A schedule that never ends, on a mesh where it always has something to try.
struct Endless {
  Endless() {
    test::write_text(file, "while true do apply('smoothing', {on = 'all', again = true}) end");
    run.choose_schedule(file.string());
    run.start(mesh, LiveRun::From::file, "cube");
  }
  test::TempFolder folder;
  std::filesystem::path file = folder / "endless.lua";
  LiveRun::Input mesh = measured(TetMesh(test::kuhn_cube(16, 0.3, 1)));
  LiveRun run;
};

/// The mesh of a run that is held or over.
TetMesh last_mesh(LiveRun& run) {
  const auto snapshot = run.take_snapshot();
  REQUIRE(snapshot);
  return snapshot->mesh;
}

/// With a prism below its first face of the bottom.
MeshData with_prism(MeshData mesh) {
  OtherElements prism;
  prism.vtk_type = 13;
  prism.vertex_count = 6;
  prism.labels = {7};
  for (const MeshData::Tet& tet : mesh.tets) {
    std::vector<std::uint32_t> face;
    std::copy_if(tet.vertices.begin(), tet.vertices.end(), std::back_inserter(face),
                 [&](std::uint32_t v) { return mesh.points[v].z() == 0; });
    if (face.size() != 3) continue;
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const std::uint32_t v : face) mesh.points.push_back(mesh.points[v] - Point(0, 0, 1));
    prism.vertices = {face[0], face[1], face[2], first, first + 1, first + 2};
    mesh.other_elements = {prism};
    return mesh;
  }
  return mesh;
}

void check_sound(const TetMesh& mesh, const LiveRun::Input& before) {
  CHECK(to_string(check_integrity(mesh)) == "");
  CHECK(surface_fingerprint(mesh) == surface_fingerprint(before.mesh));
  CHECK(count_not_positive(mesh) == 0);
}

}  // namespace

TEST_CASE("a live run gives the mesh of improve(), bit for bit, as often as it is made") {
  Mesh improved = load(test::asset("sheet.mesh"));
  const Result result = improve(improved);
  TetMesh plain(MeshAccess::take(improved));
  plain.set_standard(Standard(Goal{}));

  const LiveRun::Input mesh = live_input("sheet.mesh");
  LiveRun run;
  for (int i = 0; i < 2; ++i) {
    CAPTURE(i);
    run.start(mesh, LiveRun::From::file, "sheet.mesh");
    CHECK(run.wait(kForever) == LiveState::finished);
    CHECK(last_mesh(run) == plain);
  }
  const LiveProgress progress = run.progress();
  REQUIRE(progress.passes.size() == result.passes.size());
  std::size_t attempts = 0;
  for (std::size_t i = 0; i < progress.passes.size(); ++i) {
    CHECK(progress.passes[i].name == result.passes[i].name);
    CHECK(progress.passes[i].round == result.passes[i].round);
    CHECK(progress.passes[i].attempts == result.passes[i].attempts());
    CHECK(progress.passes[i].accepted == result.passes[i].accepted());
    CHECK(progress.passes[i].after.n_bad == result.passes[i].after.n_bad);
    attempts += result.passes[i].attempts();
  }
  CHECK(progress.attempts == attempts);
}

TEST_CASE("what a live run saves has the bytes of improve, whatever the schedule and the mesh") {
  const test::TempFolder folder;
  const auto write = [&](const std::string& name, const MeshData& data) {
    write_mesh(folder / name, MeshView(TetMesh(data)));
    return folder / name;
  };
  const std::filesystem::path script = folder / "own.lua";
  test::write_text(script, "for _ = 1, 2 do local_reconnection{} smooth{} insert_points{} end");
  const std::filesystem::path spoils = folder / "spoils.lua";
  test::write_text(
      spoils,
      "local_reconnection{} judge_by{measure = 'sine', price = 0} "
      "for _ = 1, 3 do apply({'centroid_insertion', desperate = 2}, {on = 'all'}) end");
  MeshData flat = contract::kuhn_cube(4, 0.1, 1);
  for (Point& p : flat.points) p.z() *= 0.15;
  const auto layered =
      write("layered.mesh",
            test::make_layered(test::plane_wall(8), {.heights = test::growing_heights(4, 0.05, 1.2),
                                                     .core = {0.9, 0.9},
                                                     .jitter = 0.1,
                                                     .seed = 2})
                .data);
  const auto ball = write("ball.mesh", test::delaunay_ball(300, 1));
  const std::filesystem::path labels = test::asset("two_materials.mesh");
  const std::filesystem::path tangled = folder / "tangled.mesh";
  write_mesh(tangled, contract::tangled_ball(300, 1));
  const std::filesystem::path mixed = folder / "mixed.mesh";
  write_mesh(mixed, with_prism(test::kuhn_cube(3, 0.3, 1)));
  std::vector<std::pair<std::string, std::filesystem::path>> runs = {
      {"thorough", ball},         {"polish", ball},
      {script.string(), labels},  {"shell", layered},
      {"conservative", layered},  {"grummp", ball},
      {"shell", mixed},           {"stellar", mixed},
      {"shell", tangled},         {"conservative", tangled},
      {script.string(), layered}, {spoils.string(), write("flat.mesh", flat)}};
  for (const std::string_view name : builtin_schedule_names()) {
    if (name != "adapt") runs.emplace_back(name, labels);  // which needs lengths
  }
  for (const auto& each : runs) {
    const std::string& schedule = each.first;
    const std::filesystem::path& file = each.second;
    CAPTURE(schedule);
    CAPTURE(file);
    Mesh mesh = load(file);
    const Result result = improve(mesh, {.schedule = schedule, .goal = {32, 148}});
    save(folder / "improved.mesh", mesh);
    if (file == layered) CHECK(result.layer_tets > 0);
    TestSession s(test::one_tet());
    s.document.open(file);
    s.run("goal", {32, 148});
    s.run("live_schedule", {schedule});
    s.run("live_run");
    const nlohmann::json run = s.run("live_wait");
    CHECK(run["error"] == "");
    CHECK(run["passes"].size() == result.passes.size());
    s.run("save", {(folder / "live.mesh").string()});
    CHECK(test::read_text(folder / "live.mesh") == test::read_text(folder / "improved.mesh"));
  }
}

TEST_CASE("a live run keeps the walls between parts that share a label") {
  // Elements 1 to 6 of each cell lie in one of two parts, by the cell.
  const test::TempFolder folder;
  const MeshData cube = test::kuhn_cube(6, 0.35, 3);
  MeshArrays arrays;
  for (const Point& p : cube.points) arrays.points.push_back({p.x(), p.y(), p.z()});
  for (const MeshData::Tet& tet : cube.tets) {
    arrays.tets.push_back(tet.vertices);
    double x = 0;
    for (const std::uint32_t v : tet.vertices) x += cube.points[v].x() / 4;
    arrays.tet_parts.push_back(x < 0.5 ? 1 : 2);
  }
  save(folder / "parts.msh", Mesh(std::move(arrays)));
  Mesh mesh = load(folder / "parts.msh");
  REQUIRE_FALSE(mesh.arrays().tet_parts.empty());
  improve(mesh);
  save(folder / "improved.mesh", mesh);
  TestSession s(test::one_tet());
  s.document.open(folder / "parts.msh");
  s.run("live_run");
  CHECK(s.run("live_wait")["error"] == "");
  s.run("save", {(folder / "live.mesh").string()});
  const auto points = [](const std::filesystem::path& file) {
    const MeshData data = read_mesh(file);
    return std::pair(data.points, data.tets.size());
  };
  CHECK(points(folder / "live.mesh") == points(folder / "improved.mesh"));
}

TEST_CASE("a run from what is shown starts with the result of the one before") {
  const test::TempFolder folder;
  test::write_text(folder / "sweep.lua", "local_reconnection{sweeps = 1}");
  const LiveRun::Input mesh = live_input("sheet.mesh");
  LiveRun run;
  run.choose_schedule((folder / "sweep.lua").string());
  run.start(mesh, LiveRun::From::file, "sheet.mesh");
  run.wait(kForever);
  const LiveRun::Input first = measured(last_mesh(run));
  CHECK(first.statistics.n_bad < mesh.statistics.n_bad);
  run.start(first, LiveRun::From::shown, "sheet.mesh");
  run.wait(kForever);
  const TetMesh second = last_mesh(run);
  CHECK(quality_indicators(second).n_bad < first.statistics.n_bad);
  run.start(first, LiveRun::From::file, "sheet.mesh");
  run.wait(kForever);
  CHECK(last_mesh(run) == first.mesh);
}

TEST_CASE("a paused run does nothing until it goes on") {
  Endless endless;
  LiveRun& run = endless.run;
  run.ask(Demand::pause);
  REQUIRE(run.wait(kForever) == LiveState::paused);
  const TetMesh before = last_mesh(run);
  const LiveProgress then = run.progress();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  CHECK(run.state() == LiveState::paused);
  CHECK(run.progress().attempts == then.attempts);
  CHECK(run.progress().seconds == then.seconds);
  CHECK(run.take_snapshot() == nullptr);

  run.ask(Demand::go_on);
  run.ask(Demand::to_next_pass);
  REQUIRE(run.wait(kForever) == LiveState::paused);
  CHECK(run.progress().attempts > then.attempts);
  CHECK_FALSE(last_mesh(run) == before);
}

TEST_CASE("a step ends after the next call that changes the mesh, or after the pass") {
  Endless endless;
  LiveRun& run = endless.run;
  run.ask(Demand::pause);
  run.wait(kForever);
  for (int i = 0; i < 5; ++i) {
    const LiveProgress before = run.progress();
    run.ask(Demand::to_next_accepted);
    REQUIRE(run.wait(kForever) == LiveState::paused);
    const LiveProgress now = run.progress();
    CHECK(now.accepted == before.accepted + 1);
    REQUIRE(now.last_accepted);
    CHECK(now.last_accepted->operator_name == "smoothing");
    CHECK(now.last_accepted->after >= now.last_accepted->before);
  }
  for (int i = 0; i < 2; ++i) {
    const LiveProgress before = run.progress();
    run.ask(Demand::to_next_pass);
    REQUIRE(run.wait(kForever) == LiveState::paused);
    CHECK(run.progress().passes.size() == before.passes.size() + 1);
  }
}

TEST_CASE("a run that is paused or stopped anywhere has a sound mesh with the old surface") {
  // Large enough to be worked on in blocks, where the counts of the mesh lag behind.
  const LiveRun::Input mesh = measured(TetMesh(test::kuhn_cube(24, 0.3, 1)));
  LiveRun run;
  run.start(mesh, LiveRun::From::file, "cube");
  for (int i = 0; i < 20; ++i) run.ask(Demand::to_next_accepted), run.wait(kForever);
  check_sound(last_mesh(run), mesh);
  run.ask(Demand::to_next_pass);
  REQUIRE(run.wait(kForever) == LiveState::paused);
  run.ask(Demand::to_next_accepted);
  REQUIRE(run.wait(kForever) == LiveState::paused);
  check_sound(last_mesh(run), mesh);
  run.ask(Demand::stop);
  try {
    run.ask(Demand::pause);  // too late
  } catch (const Error&) {   // later still: the run has already ended
  }
  CHECK(run.wait(kForever) == LiveState::stopped);
  check_sound(last_mesh(run), mesh);
  CHECK_THROWS_AS(run.ask(Demand::go_on), Error);
}

TEST_CASE("a run ends with its owner, whatever it does") {
  { const Endless at_work; }
  {
    Endless paused;
    paused.run.ask(Demand::pause);
    paused.run.wait(kForever);
  }
  Endless looping;
  looping.run.forget();
  test::write_text(looping.file, "quality() while true do end");  // no pass, no call
  looping.run.start(looping.mesh, LiveRun::From::file, "sheet.mesh");
  CHECK(looping.run.is_active());
}

TEST_CASE("a mistake in a schedule is told with its line, and the mesh so far stays") {
  const test::TempFolder folder;
  const std::filesystem::path file = folder / "bad.lua";
  const LiveRun::Input mesh = live_input("sheet.mesh");
  LiveRun run;
  test::write_text(file, "parameter{'n', default = 1}\nsmooth{}\nsmooth{cycels = 1}\n");
  run.choose_schedule(file.string());
  run.start(mesh, LiveRun::From::file, "sheet.mesh");
  CHECK(run.wait(kForever) == LiveState::failed);
  CHECK(run.progress().error.find("bad.lua:3: smooth has no parameter 'cycels'") !=
        std::string::npos);
  CHECK(run.progress().passes.size() == 1);
  check_sound(last_mesh(run), mesh);

  // The file is read again; what cannot even be read starts nothing.
  test::write_text(file, "smooth{}\n");
  run.start(mesh, LiveRun::From::file, "sheet.mesh");
  CHECK(run.wait(kForever) == LiveState::finished);
  test::write_text(file, "smooth{\n");
  CHECK_THROWS_WITH_AS(run.start(mesh, LiveRun::From::file, "sheet.mesh"),
                       doctest::Contains("bad.lua:2"), Error);
  CHECK(run.state() == LiveState::finished);
}

TEST_CASE("parameters are checked when they are set, and kept for schedules that have them") {
  LiveRun run;
  CHECK_THROWS_WITH_AS(run.set("rounds", "3"), doctest::Contains("max_rounds"), Error);
  CHECK_THROWS_WITH_AS(run.set("max_rounds", "-1"), doctest::Contains("0 to 10000"), Error);
  CHECK_THROWS_AS(run.choose_schedule("shall"), Error);
  CHECK(run.schedule_name() == "shell");
  run.set("max_rounds", "7");
  run.set("max_rounds", "0");
  const auto rounds = [&] { return run.value_of(run.info().parameters.front()); };
  REQUIRE(run.info().parameters.front().name == "max_rounds");
  CHECK(rounds() == "0");
  const LiveRun::Input mesh = live_input("sheet.mesh");
  run.start(mesh, LiveRun::From::file, "sheet.mesh");
  run.set("max_rounds", "5");  // for the next run
  CHECK(run.wait(kForever) == LiveState::finished);
  CHECK(run.progress().passes.empty());
  run.choose_schedule("grummp");
  run.choose_schedule("shell");
  CHECK((rounds() == "5" || rounds() == "30"));
}

TEST_CASE("a run that is recorded leaves a complete trace, also when it is stopped") {
  const test::TempFolder folder;
  Endless endless;
  endless.run.forget();
  endless.run.trace = folder / "run.trace";
  endless.run.start(endless.mesh, LiveRun::From::file, "sheet.mesh");
  CHECK_THROWS_AS(endless.run.start(endless.mesh, LiveRun::From::file, "sheet.mesh"), Error);
  endless.run.ask(Demand::to_next_pass);
  endless.run.wait(kForever);
  CHECK(endless.run.progress().trace == "");
  endless.run.ask(Demand::stop);
  REQUIRE(endless.run.wait(kForever) == LiveState::stopped);
  const LiveProgress progress = endless.run.progress();
  CHECK(progress.trace == (folder / "run.trace").string());
  const TraceFile trace(progress.trace);
  CHECK(trace.calls().size() == progress.attempts);  // smoothing calls no other operator
  CHECK(trace.header().schedule == endless.file.string());
  endless.run.trace = folder / "missing" / "run.trace";
  endless.run.start(endless.mesh, LiveRun::From::file, "sheet.mesh");
  CHECK(endless.run.wait(kForever) == LiveState::failed);
  CHECK(endless.run.progress().error.find("missing") != std::string::npos);
}

TEST_CASE("the document shows a run, and opening another mesh ends it") {
  TestSession s(test::one_tet());
  const test::TempFolder folder;
  s.document.open(TETMEND_SOURCE_DIR "/assets/meshes/sheet.mesh");
  const MeshStatistics before = s.document.statistics();
  // A run that waits for the script, however slow the script is.
  test::write_text(folder / "endless.lua",
                   "while true do apply('smoothing', {on = 'all', again = true}) end");
  run_script(s.session, "local endless = '" + (folder / "endless.lua").string() + "'" + R"lua(
    expect(live_schedule("shell").max_rounds == "30", "the default")
    live_set("max_rounds", 2)
    expect(live_schedule().max_rounds == "2", "what was set")
    live_run()
    local run = live_wait()
    expect(run.state == "finished" and #run.passes > 0, "a run to its end")
    expect(run.passes[#run.passes].n_bad == state().bad, "the mesh that is shown is the last")
    live_schedule(endless)
    live_run()
    live_step_pass()
    expect(live_wait().state == "paused", "a pause after a pass")
    live_step()
    expect(live_wait().accepted > 0, "a step")
    live_continue()
    live_pause()
    live_wait()
    live_stop()
    expect(live_wait().state == "stopped", "the end")
  )lua",
             "test");
  // Smoothing without end had made more tets bad, so the run went back.
  CHECK(s.document.statistics().n_bad == before.n_bad);
  CHECK(s.document.statistics().q_worst == before.q_worst);
  REQUIRE(s.document.statistics_before());
  CHECK(s.document.statistics_before()->n_bad == before.n_bad);
  s.run("save", {(folder / "better.mesh").string()});
  CHECK(TetMesh(read_mesh(folder / "better.mesh")).tet_count() == s.document.statistics().tets);

  s.run("live_run", {"shown"});
  CHECK(s.document.statistics_before()->n_bad == s.document.statistics().n_bad);
  s.document.open(TETMEND_SOURCE_DIR "/assets/meshes/two_materials.mesh");
  CHECK(s.document.live.state() == LiveState::idle);
  CHECK_THROWS_WITH_AS(s.run("live_pause"), doctest::Contains("no run is at work"), Error);
  CHECK_THROWS_WITH_AS(s.run("live_run", {"here"}), doctest::Contains("file, shown"), Error);
}

TEST_CASE(
    "the trace of a recorded run opens in the debugger, and the run can be made again there") {
  TestSession s(test::delaunay_ball(100, 1));
  const test::TempFolder folder;
  CHECK_THROWS_WITH_AS(s.run("live_debug"), doctest::Contains("no run yet"), Error);
  s.run("live_run");
  s.run("live_wait");
  CHECK(s.document.debugger() == nullptr);
  s.run("live_debug");  // not recorded: its last calls
  REQUIRE(s.document.debugger() != nullptr);
  CHECK(s.document.debugger()->file().calls().size() > 100);

  s.run("live_record", {(folder / "run.trace").string()});
  const std::size_t bad_before = s.document.live.input()->statistics.n_bad;
  s.run("live_run");
  const nlohmann::json run = s.run("live_wait");
  REQUIRE(run["state"] == "finished");
  const TetMesh result = s.document.mesh();
  s.run("live_debug");
  REQUIRE(s.document.debugger() != nullptr);
  CHECK(s.document.debugger()->position() == 0);
  s.run("to_end");
  CHECK(s.document.statistics().n_bad == run["passes"].back()["n_bad"]);
  CHECK(s.document.statistics().tets == result.tet_count());
  CHECK(s.document.statistics().q_worst == doctest::Approx(compute_statistics(result).q_worst));

  s.run("to_begin");
  s.run("live_run");  // into the file that is open here
  const nlohmann::json again = s.run("live_wait");
  CHECK(s.document.debugger() == nullptr);
  // The same mesh with other numbers.
  REQUIRE(s.document.statistics_before());
  CHECK(s.document.statistics_before()->n_bad == bad_before);
  CHECK(again["passes"].back()["n_bad"] < bad_before);
  s.run("live_debug");
  CHECK(s.document.debugger() != nullptr);
}

TEST_CASE("the goal of the viewer is that of the figures, of live runs and of their traces") {
  TestSession s(test::delaunay_ball(100, 1));
  const test::TempFolder folder;
  const std::size_t bad = s.document.statistics().n_bad;
  CHECK_THROWS_WITH_AS(s.run("goal", {80}), doctest::Contains("at most 70"), Error);
  CHECK(s.document.statistics().n_bad == bad);
  CHECK(s.run("goal", {40})["max"] == 140);
  const std::size_t more = s.document.statistics().n_bad;
  CHECK(more > bad);
  CHECK(s.document.scene().bad_shown == more);

  test::write_text(folder / "goals.lua", "smooth{} goal{min = 10} smooth{}");
  s.run("live_schedule", {(folder / "goals.lua").string()});
  s.run("live_record", {(folder / "run.trace").string()});
  for (int i = 0; i < 2; ++i) {  // the second begins with the goal of the viewer, too
    s.run("live_run");
    REQUIRE(s.run("live_wait")["state"] == "finished");
    REQUIRE(s.document.statistics_before());
    CHECK(s.document.statistics_before()->n_bad == more);
    CHECK(s.run("goal")["min"] == 40);  // of the viewer again
  }
  s.run("goal", {30});
  s.run("live_run");
  REQUIRE(s.run("live_wait")["state"] == "finished");
  CHECK(s.document.statistics_before()->n_bad == bad);
  s.run("live_debug");
  CHECK(s.run("goal")["min"] == 30);
  CHECK(s.document.statistics().n_bad == bad);
  s.run("to_end");
  CHECK(s.run("goal")["min"] == 30);  // the schedule is over
  CHECK_THROWS_WITH_AS(s.run("goal", {20}), doctest::Contains("trace"), Error);
}

TEST_CASE(
    "a paused run is the debugger of its last calls, backwards too, and goes on as if never held") {
  const auto improved = [](bool is_looked_into) {
    TestSession s(test::delaunay_ball(300, 1));
    s.run(is_looked_into ? "live_start" : "live_run");
    if (is_looked_into) {
      REQUIRE(s.run("live_wait")["state"] == "paused");
      CHECK_THROWS_WITH_AS(s.run("live_debug"), doctest::Contains("no call yet"), Error);
      for (int i = 0; i < 5; ++i) {
        s.run("live_step_call");
        REQUIRE(s.run("live_wait")["state"] == "paused");
        const std::size_t bad = s.document.statistics().n_bad;
        const std::size_t tets = s.document.mesh().tet_count();
        s.run("live_debug");
        REQUIRE(s.document.debugger() != nullptr);
        CHECK(s.document.debugs_live());
        const TraceFile& file = s.document.debugger()->file();
        CHECK(std::count_if(file.calls().begin(), file.calls().end(),
                            [](const Call& call) { return call.parent == kNoCall; }) == i + 1);
        CHECK(s.document.statistics().n_bad == bad);
        CHECK(s.document.mesh().tet_count() == tets);
        CHECK(s.document.debugger()->call() != kNoCall);  // the one that has just ended
        CHECK(s.document.debugger()->study() != nullptr);
        s.run("back_over");
        CHECK(s.document.debugger()->position() < s.document.debugger()->end());
        s.run("to_begin");
      }
      s.run("live_continue");
    }
    REQUIRE(s.run("live_wait")["state"] == "finished");
    CHECK(s.document.debugger() == nullptr);
    const test::TempFolder folder;
    s.run("save", {(folder / "out.mesh").string()});
    return test::read_text(folder / "out.mesh");
  };
  CHECK(improved(true) == improved(false));
}

TEST_CASE("in the window a pause shows its calls by itself, and the run its mesh again") {
  TestSession s(test::delaunay_ball(300, 1));
  s.document.debugs_pauses = true;
  const Camera camera = s.document.view.camera;
  s.run("live_start");
  REQUIRE(s.run("live_wait")["state"] == "paused");
  CHECK(s.document.debugger() == nullptr);  // there is no call yet
  s.run("live_step");
  REQUIRE(s.run("live_wait")["state"] == "paused");
  REQUIRE(s.document.debugger() != nullptr);
  CHECK(s.document.debugger()->position() == s.document.debugger()->end());
  CHECK(s.document.view.scene.isolate);
  s.run("breakpoint", {"operator edge_split"});  // of the run, not of what is looked at
  CHECK(s.document.live.breakpoints.size() == 1);
  s.run("clear_breakpoints");
  SUBCASE("when it has gone on to its end") {
    s.run("live_continue");
    REQUIRE(s.run("live_wait")["state"] == "finished");
  }
  SUBCASE("when it ends at another call") {
    for (int i = 0; i < 3; ++i) s.run("back_over");
    CHECK_FALSE(s.document.view.camera == camera);
    s.run("live_stop");
    REQUIRE(s.run("live_wait")["state"] == "stopped");
  }
  CHECK(s.document.debugger() == nullptr);
  CHECK_FALSE(s.document.view.scene.isolate);
  CHECK(s.document.view.camera == camera);  // and not in the last hole
}

TEST_CASE("a pause in the middle of a call shows that call as under way") {
  TestSession s(test::delaunay_ball(300, 1));
  s.run("breakpoint", {"deeper 0"});
  s.run("live_run");
  REQUIRE(s.run("live_wait")["state"] == "paused");
  s.run("live_debug");
  const auto calls = s.document.debugger()->file().calls();
  const auto& stack = s.document.debugger()->stack();
  REQUIRE(stack.size() >= 2);
  CHECK_FALSE(calls[stack.front()].verdict);
  s.run("live_stop");
}

TEST_CASE(
    "a parameter that is changed at a pause holds from the next pass on, and is in the trace") {
  TestSession s(test::delaunay_ball(300, 1));
  const test::TempFolder folder;
  s.run("live_schedule", {"operator recursive_shell_transformation"});
  s.run("live_set", {"rounds_at_most", 3});
  s.run("live_record", {(folder / "run.trace").string()});
  CHECK_THROWS_WITH_AS(s.run("live_hold", {"recursive_shell_transformation", "max_level", 1}),
                       doctest::Contains("no run is at work"), Error);
  s.run("live_start");
  s.run("live_wait");
  s.run("live_step_pass");
  REQUIRE(s.run("live_wait")["state"] == "paused");
  CHECK_THROWS_WITH_AS(s.run("live_hold", {"recursive_shell_transformation", "max_level", 999}),
                       doctest::Contains("max_level"), Error);
  CHECK_THROWS_AS(s.run("live_hold", {"nope", "max_level", 1}), Error);
  s.run("live_hold", {"recursive_shell_transformation", "max_level", 1});
  CHECK(s.run("live_state")["held_parameters"] ==
        nlohmann::json{"recursive_shell_transformation: max_level = 1"});
  s.run("live_continue");
  REQUIRE(s.run("live_wait")["state"] == "finished");
  const TraceFile file(folder / "run.trace");
  REQUIRE(file.parameter_changes().size() == 1);
  REQUIRE(file.passes().size() >= 2);
  CHECK(file.parameter_changes()[0].event == file.passes()[1].events.begin - 1);
  bool was_other = false;
  for (const Call& call : file.calls()) {
    if (call.parent != kNoCall) continue;
    const bool is_later = call.events.begin > file.parameter_changes()[0].event;
    const bool is_held = file.name(call.settings).find("max_level = 1") != std::string_view::npos;
    CHECK(is_held == is_later);
    was_other = was_other || !is_held;
  }
  CHECK(was_other);
}

TEST_CASE("a run at work is not debugged") {
  Endless endless;
  endless.run.forget();
  TestSession s(test::kuhn_cube(16, 0.3, 1));
  s.run("live_schedule", {endless.file.string()});
  s.run("live_record", {(endless.folder / "run.trace").string()});
  s.run("live_run");
  CHECK_THROWS_WITH_AS(s.run("live_debug"), doctest::Contains("still at work"), Error);
  s.run("live_stop");
  REQUIRE(s.run("live_wait")["state"] == "stopped");
  s.run("live_debug");
  CHECK(s.document.debugger() != nullptr);
}

TEST_CASE("a run that fails says so in the status line") {
  TestSession s(test::delaunay_ball(100, 1));
  const test::TempFolder folder;
  test::write_text(folder / "bad.lua", "smooth{}\nerror('no way')\n");
  s.run("live_schedule", {(folder / "bad.lua").string()});
  s.run("live_run");
  CHECK(s.run("live_wait")["state"] == "failed");
  CHECK(s.document.message.is_error);
  CHECK(s.document.message.text.find("bad.lua:2: no way") != std::string::npos);
}

TEST_CASE("a run that begins paused has made no call, and steps from the first one on") {
  const LiveRun::Input mesh = live_input("sheet.mesh");
  LiveRun plain;
  plain.start(mesh, LiveRun::From::file, "sheet.mesh");
  CHECK(plain.wait(kForever) == LiveState::finished);
  const TetMesh truth = last_mesh(plain);

  LiveRun run;
  run.paused = true;
  run.start(mesh, LiveRun::From::file, "sheet.mesh");
  CHECK(run.wait(kForever) == LiveState::paused);
  CHECK(run.progress().attempts == 0);
  CHECK(last_mesh(run).tet_count() == mesh.mesh.tet_count());
  for (std::size_t i = 1; i <= 5; ++i) {
    run.ask(Demand::to_next_call);
    CHECK(run.wait(kForever) == LiveState::paused);
    const LiveProgress progress = run.progress();
    CHECK(progress.attempts == i);
    REQUIRE(progress.last);
    CHECK(progress.last->number == i);
    CHECK_FALSE(progress.last->target.empty());
    check_sound(last_mesh(run), mesh);
  }
  run.ask(Demand::to_next_accepted);
  CHECK(run.wait(kForever) == LiveState::paused);
  CHECK(run.progress().last->verdict == Verdict::accepted);
  CHECK(run.progress().last->number == run.progress().last_accepted->number);
  run.ask(Demand::go_on);
  CHECK(run.wait(kForever) == LiveState::finished);
  CHECK(last_mesh(run) == truth);
}

TEST_CASE("breakpoints hold a live run at the end of the call for which they hold") {
  const LiveRun::Input mesh = live_input("sheet.mesh");
  LiveRun run;
  run.breakpoints = {{parse_condition("accepted and worse than 0.9")},
                     {parse_condition("operator smoothing"), false}};
  run.start(mesh, LiveRun::From::file, "sheet.mesh");
  for (int i = 0; i < 3; ++i) {
    REQUIRE(run.wait(kForever) == LiveState::paused);
    const LiveProgress progress = run.progress();
    CHECK(progress.breakpoint == "accepted and worse than 0.9");
    CHECK(progress.last->verdict == Verdict::accepted);
    run.ask(Demand::go_on);
  }
  REQUIRE(run.wait(kForever) == LiveState::paused);
  run.breakpoints.clear();
  run.tell_breakpoints();
  run.ask(Demand::go_on);
  CHECK(run.wait(kForever) == LiveState::finished);
  CHECK(run.progress().breakpoint.empty());
}

TEST_CASE("a breakpoint on an edge is met where the trace of the run has it") {
  const test::TempFolder folder;
  const LiveRun::Input mesh = live_input("sheet.mesh");
  LiveRun run;
  run.trace = folder / "live.trace";
  run.start(mesh, LiveRun::From::file, "sheet.mesh");
  CHECK(run.wait(kForever) == LiveState::finished);
  const TraceFile file(folder / "live.trace");
  // The last outermost call with an edge that is the target of a call in it.
  std::size_t outermost = 0;
  std::size_t wanted = 0;
  std::string text;
  for (const Call& call : file.calls()) {
    outermost += call.depth == 0 ? 1 : 0;
    if (call.depth == 0 || call.target_size != 2 || !text.empty()) continue;
    text = fmt::format("edge {} {}", call.target()[0].index(), call.target()[1].index());
    wanted = outermost;
  }
  REQUIRE_FALSE(text.empty());
  std::size_t first = 0;
  outermost = 0;
  const Condition condition = parse_condition(text);
  for (const Call& call : file.calls()) {
    outermost += call.depth == 0 ? 1 : 0;
    const ConditionCall asked{"", call.level, call.target(), {}, 0};
    if (first == 0 && holds(condition.terms[0], asked, {})) first = outermost;
  }
  CHECK(first <= wanted);
  LiveRun again;
  again.breakpoints = {{condition}};
  again.start(mesh, LiveRun::From::file, "sheet.mesh");
  REQUIRE(again.wait(kForever) == LiveState::paused);
  CHECK(again.progress().attempts == first - 1);
  CHECK(again.progress().last->number == first);
  CHECK(again.progress().last->is_under_way);
  again.ask(Demand::stop);
}

TEST_CASE("a breakpoint holds inside of a recursion, as often as the trace has such calls") {
  const test::TempFolder folder;
  const LiveRun::Input mesh = live_input("folded_sheet.mesh");
  LiveRun run;
  run.trace = folder / "live.trace";
  run.breakpoints = {{parse_condition("deeper 1")}};
  run.start(mesh, LiveRun::From::file, "folded_sheet.mesh");
  std::size_t held = 0;
  while (run.wait(kForever) == LiveState::paused) {
    ++held;
    const LiveProgress progress = run.progress();
    CHECK(progress.breakpoint == "deeper 1");
    CHECK(progress.last->level > 1);
    CHECK(progress.last->is_inside);
    CHECK(progress.last->is_under_way);
    CHECK(progress.last->number == progress.attempts + 1);
    if (held % 16 == 1) check_sound(last_mesh(run), mesh);
    run.ask(Demand::go_on);
  }
  CHECK(run.state() == LiveState::finished);
  const TraceFile file(folder / "live.trace");
  const auto& calls = file.calls();
  CHECK(held > 10);
  CHECK(held == static_cast<std::size_t>(std::count_if(
                    calls.begin(), calls.end(), [](const Call& call) { return call.level > 1; })));
  const auto end = last_mesh(run);
  LiveRun plain;
  plain.start(mesh, LiveRun::From::file, "sheet.mesh");
  CHECK(plain.wait(kForever) == LiveState::finished);
  CHECK(last_mesh(plain) == end);
}

TEST_CASE("breakpoints that are taken away inside of a call hold no more, and new ones do") {
  const LiveRun::Input mesh = live_input("sheet.mesh");
  LiveRun run;
  run.breakpoints = {{parse_condition("deeper 0")}};
  run.start(mesh, LiveRun::From::file, "sheet.mesh");
  REQUIRE(run.wait(kForever) == LiveState::paused);
  const std::size_t call = run.progress().last->number;
  CHECK(run.progress().last->level > 0);
  run.breakpoints = {{parse_condition("level 0 and accepted")}};
  run.tell_breakpoints();
  run.ask(Demand::go_on);
  REQUIRE(run.wait(kForever) == LiveState::paused);
  CHECK(run.progress().breakpoint == "level 0 and accepted");
  CHECK(run.progress().last->number >= call);
  run.breakpoints = {{parse_condition("deeper 0")}};
  run.tell_breakpoints();
  run.ask(Demand::go_on);
  REQUIRE(run.wait(kForever) == LiveState::paused);
  run.breakpoints.clear();
  run.tell_breakpoints();
  run.ask(Demand::go_on);
  CHECK(run.wait(kForever) == LiveState::finished);
}

TEST_CASE("a run that is held inside of a call can be stopped, and its mesh is sound") {
  const LiveRun::Input mesh = live_input("sheet.mesh");
  LiveRun run;
  run.breakpoints = {{parse_condition("deeper 1")}};
  run.start(mesh, LiveRun::From::file, "sheet.mesh");
  REQUIRE(run.wait(kForever) == LiveState::paused);
  run.ask(Demand::stop);
  CHECK(run.wait(kForever) == LiveState::stopped);
  check_sound(last_mesh(run), mesh);
}

TEST_CASE("a run of some changes a second shows each, and gives the same mesh") {
  const LiveRun::Input mesh = live_input("sheet.mesh");
  LiveRun run;
  run.set_speed(200);
  run.paused = true;
  run.start(mesh, LiveRun::From::file, "sheet.mesh");
  CHECK(run.wait(kForever) == LiveState::paused);
  const auto begin = std::chrono::steady_clock::now();
  run.ask(Demand::go_on);
  while (run.progress().accepted < 20) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  CHECK(passed.count() > 15 / 200.0);
  CHECK(run.take_snapshot() != nullptr);
  run.set_speed(0);
  CHECK(run.wait(kForever) == LiveState::finished);
  CHECK_THROWS_AS(run.set_speed(-1), Error);
}

TEST_CASE("an operator alone is a schedule with its parameters") {
  LiveRun run;
  run.choose_schedule("operator recursive_shell_transformation");
  const Registry registry = Registry::builtin();
  const OperatorInfo& info = registry.find("recursive_shell_transformation");
  const auto& parameters = run.info().parameters;
  CHECK(parameters.size() == info.parameters.size() + 1);
  for (const ParameterSpec& spec : info.parameters) {
    CHECK(std::any_of(parameters.begin(), parameters.end(),
                      [&](const ScheduleParameter& p) { return p.name == spec.name; }));
  }
  run.start(live_input("sheet.mesh"), LiveRun::From::file, "sheet.mesh");
  CHECK(run.wait(kForever) == LiveState::finished);
  CHECK(run.progress().error.empty());
  CHECK(run.progress().accepted > 0);
  CHECK_THROWS_WITH_AS(run.choose_schedule("operator nothing"), doctest::Contains("nothing"),
                       Error);
}

TEST_CASE("every operator alone can be described") {
  const Registry registry = Registry::builtin();
  for (const OperatorInfo* info : registry.operators()) {
    CAPTURE(info->name);
    LiveRun run;
    run.choose_schedule("operator " + std::string(info->name));
    CHECK(run.info().parameters.size() == info->parameters.size() + 1);
  }
}

TEST_CASE("the camera goes to each change of a run, and back when it is over") {
  TestSession s(test::delaunay_ball(100, 1));
  const Camera before = s.document.view.camera;
  run_script(s.session, R"lua(
    expect(live_speed() == 0, "no limit")
    live_start()
    local run = live_wait()
    expect(run.state == "paused" and run.attempts == 0, "before the first call")
    live_step()
    run = live_wait()
    expect(run.last.verdict == "accepted", "a change")
  )lua",
             "t.lua");
  const LiveProgress progress = s.document.live.progress();
  REQUIRE(progress.last_accepted);
  // What is marked there has a legend, as a call of a trace has.
  REQUIRE_FALSE(s.document.highlighted().lines.empty());
  REQUIRE_FALSE(s.document.legend().empty());
  CHECK(s.document.legend().front().colour == s.document.highlighted().lines.front().colour);
  CHECK(s.document.legend().front().text.ends_with(
      fmt::format("that call {} aimed at, accepted", progress.last_accepted->number)));
  CHECK_FALSE(draw_overlay(s.document, {}).shapes.empty());
  const Point& place = progress.last_accepted->place;
  CHECK(glm::distance(s.document.view.camera.target, glm::dvec3(place.x(), place.y(), place.z())) <
        1e-9);
  s.run("live_follow");
  CHECK_FALSE(s.document.follow_changes_live);
  s.run("live_stop");
  REQUIRE(s.run("live_wait")["state"] == "stopped");
  CHECK(draw_overlay(s.document, {}).shapes.empty());
  CHECK(s.document.view.camera == before);
}

namespace {

/// With an array, a group and mid-side nodes.
MeshData rich_ball() {
  MeshData data = test::second_order(test::delaunay_ball(300, 2), 0);
  std::vector<double> numbers(data.tets.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 0.25 + static_cast<double>(i % 7);
  data.tet_data = {{"density", 1, std::move(numbers)}};
  return data;
}

}  // namespace

TEST_CASE(
    "what a live run has made is saved with all that the file held besides, as improve saves it") {
  const test::TempFolder folder;
  write_mesh(folder / "in.vtu", rich_ball());
  TestSession s(test::one_tet());
  s.document.open(folder / "in.vtu");
  s.run("live_schedule", {"shell"});
  s.run("live_run");
  s.run("live_wait");
  s.run("save", {(folder / "out.vtu").string()});
  CHECK(s.document.message.text.find("without") == std::string::npos);
  Mesh mesh = load(folder / "in.vtu");
  Options options;
  options.schedule = "shell";
  improve(mesh, options);
  save(folder / "wanted.vtu", mesh);
  CHECK(test::read_text(folder / "out.vtu") == test::read_text(folder / "wanted.vtu"));

  s.run("live_run", {"shown"});  // and what a second run makes of that
  s.run("live_wait");
  s.run("save", {(folder / "again.vtu").string()});
  CHECK(s.document.message.text.find("without") == std::string::npos);
  const MeshData again = read_mesh(folder / "again.vtu");
  CHECK(again.tet_data.size() == 1);
  CHECK(again.mid_nodes.size() > again.tets.size());
}

TEST_CASE("a run that is paused is saved with all that the file held besides, one at work is not") {
  const test::TempFolder folder;
  write_mesh(folder / "in.vtu", rich_ball());
  TestSession s(test::one_tet());
  s.document.open(folder / "in.vtu");
  s.run("live_start");
  s.run("live_wait");
  for (int i = 0; i < 5; ++i) {
    s.run("live_step");
    s.run("live_wait");
  }
  REQUIRE(s.document.live.state() == LiveState::paused);
  s.run("save", {(folder / "paused.vtu").string()});
  CHECK(s.document.message.text.find("without") == std::string::npos);
  const MeshData paused = read_mesh(folder / "paused.vtu");
  CHECK(paused.tets.size() == s.document.mesh().tet_count());
  CHECK(paused.mid_nodes.size() > paused.tets.size());
  REQUIRE(paused.tet_data.size() == 1);
  const auto& numbers = std::get<std::vector<double>>(paused.tet_data[0].values);
  REQUIRE(numbers.size() == paused.tets.size());
  CHECK(*std::max_element(numbers.begin(), numbers.end()) == 6.25);
  CHECK(*std::min_element(numbers.begin(), numbers.end()) == 0.25);
  CHECK(surface_fingerprint(TetMesh(paused)) == surface_fingerprint(TetMesh(rich_ball())));
}
