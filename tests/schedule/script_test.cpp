// SPDX-License-Identifier: MIT
// The language of schedules: what words do, what they refuse, and how scripts are stopped.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/bounds.h"
#include "kernel/error.h"
#include "kernel/integrity.h"
#include "kernel/statistics.h"
#include "schedule/limit/surface_limit.h"
#include "schedule/schedule.h"
#include "tests/schedule/script_outcome.h"
#include "tests/support/registry.h"
#include "tests/support/text.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::string note(const std::string& expression) {
  const ScriptOutcome outcome = run_script("log(" + expression + ")");
  return outcome.notes.empty() ? outcome.error : outcome.notes.front();
}

std::vector<std::string> pass_names(const ScriptOutcome& outcome) {
  std::vector<std::string> names;
  for (const PassRecord& pass : outcome.records) names.push_back(pass.name);
  return names;
}

}  // namespace

TEST_CASE("a script makes its passes in order and the mesh gets better") {
  const ScriptOutcome outcome = run_script(
      "begin_round() local_reconnection{} smooth{} suppress_points{} insert_points{}\n"
      "apply('flip_2_3', {on = 'all'})");
  CHECK(outcome.error == "");
  CHECK(pass_names(outcome) == std::vector<std::string>{"local_reconnection", "smooth",
                                                        "suppress_points", "insert_points",
                                                        "flip_2_3"});
  CHECK(outcome.round == 1);
  CHECK(outcome.records.front().accepted() > 0);
  CHECK(check_integrity(outcome.mesh).empty());
}

TEST_CASE("words do what the passes in C++ do") {
  const auto same = [](const std::string& script, auto&& pass) {
    TetMesh mesh(delaunay_ball(150, 7));
    Run by_hand(mesh, kRegistry);
    pass(by_hand);
    const ScriptOutcome outcome = run_script(script);
    CAPTURE(script);
    CHECK(outcome.error == "");
    CHECK(outcome.mesh == mesh);
    REQUIRE(outcome.records.size() == 1);
    CHECK(outcome.records[0].verdicts == by_hand.records[0].verdicts);
  };
  same("local_reconnection{}", [](Run& r) { local_reconnection(r); });
  same("local_reconnection{max_level = 0, sweeps = 1, faces = false}", [](Run& r) {
    local_reconnection(r, {.edge_settings = {{"max_level", 0}}, .face_operator = "", .sweeps = 1});
  });
  same("local_reconnection{edges = {'edge_removal'}, faces = 'flip_2_3'}", [](Run& r) {
    local_reconnection(r, {.edge_operator = "edge_removal", .face_operator = "flip_2_3"});
  });
  same("local_reconnection{edges = {'edge_removal', order = 'angle', most_edges = 2}}", [](Run& r) {
    local_reconnection(
        r, {.edge_operator = "edge_removal", .edge_order = EdgeOrder::angle, .most_edges = 2});
  });
  same("smooth{cycles = 1, laplacian = false, on = {below = 0.3}}", [](Run& r) {
    smooth(r, {.on = {.below = 0.3f}, .settings = {{"laplacian", 0}}, .cycles = 1});
  });
  same("suppress_points{on = {worst = 20}}",
       [](Run& r) { suppress_points(r, {.on = {.worst = 20}}); });
  same("insert_points{relax = true, on = {below = 0.25, at_least = 10}}", [](Run& r) {
    insert_points(r, {.on = {.below = 0.25f, .at_least = 10}, .settings = {{"relax", 1}}});
  });
  same("apply(sequence{'flip_2_3', 'smoothing', theta_max = 150}, {on = {below = 0.6}})",
       [](Run& r) {
         Composition parts{.kind = Composition::Kind::sequence, .theta_max = 150};
         for (const char* name : {"flip_2_3", "smoothing"}) {
           parts.parts.push_back(Composition{.operator_name = name});
         }
         apply(r, {.what = parts, .on = {.below = 0.6f}});
       });
  same("apply(sequence{'edge_split', 'edge_removal', 'smoothing', desperate = 0.3})", [](Run& r) {
    Composition parts{.kind = Composition::Kind::sequence, .desperate = 0.3};
    for (const char* name : {"edge_split", "edge_removal", "smoothing"}) {
      parts.parts.push_back(Composition{.operator_name = name});
    }
    apply(r, {.what = parts});
  });
  same("apply(first_of{{'edge_split', order = 'longest', steps = 3}, 'smoothing'}, {on = 'all'})",
       [](Run& r) {
         Composition split{.operator_name = "edge_split",
                           .settings = {{"steps", 3}},
                           .order = EdgeOrder::longest};
         Composition both{.kind = Composition::Kind::first_of,
                          .parts = {split, Composition{.operator_name = "smoothing"}}};
         apply(r, {.what = both, .on = {.below = Selection::kAll}});
       });
}

TEST_CASE("a pass tells how many attempts it accepted and made") {
  const ScriptOutcome outcome = run_script("log(smooth{cycles = 1})");
  REQUIRE(outcome.notes.size() == 1);
  CHECK(outcome.notes[0] == std::to_string(outcome.records[0].accepted()) + " " +
                                std::to_string(outcome.records[0].attempts()));
}

TEST_CASE("quality tells the figures of the mesh, the costly ones until the next pass") {
  const MeshStatistics truth = compute_statistics(TetMesh(delaunay_ball(150, 7)));
  CHECK(note("quality().n_bad") == std::to_string(truth.n_bad));
  CHECK(note("quality().tets") == std::to_string(truth.tets));
  CHECK(note("quality().passes") == "0");
  CHECK(note("quality().goal_min .. ' ' .. quality().goal_max") == "30.0 150.0");
  CHECK(note("quality().q_worst == quality().q_worst") == "true");
  CHECK(std::stod(note("quality().theta_min")) == doctest::Approx(truth.theta_min));
  CHECK(std::stod(note("quality().theta_max")) == doctest::Approx(truth.theta_max));
  CHECK(std::stod(note("quality().lambda")) == doctest::Approx(truth.lambda));
  CHECK(
      run_script("local q = quality() local theta = q.theta_min smooth{} log(q.theta_min == theta)")
          .notes.front() == "true");
  CHECK(contains(run_script("local q = quality() smooth{}\nlog(q.lambda)").error,
                 "test.lua:2: quality(): lambda was not read before the next pass"));
  CHECK(contains(run_script("log(quality().n_bat)").error,
                 "quality() has no 'n_bat'; valid: date, goal_max, "));
  const ScriptOutcome later = run_script("smooth{} log(quality().n_bad)");
  CHECK(later.notes.front() == std::to_string(quality_indicators(later.mesh).n_bad));
}

TEST_CASE("'since' selects tets around which something has changed") {
  const std::string changes = "local date = quality().date\n";
  const std::string apply =
      "log(select(2, apply('smoothing', {on = {below = 100, since = date}})))";
  CHECK(run_script(changes + apply).notes.front() == "0");
  const ScriptOutcome some = run_script(changes + "smooth{on = {worst = 1}, cycles = 1}\n" + apply);
  const ScriptOutcome all =
      run_script("smooth{on = {worst = 1}, cycles = 1}\nlocal date = 0\n" + apply);
  CHECK(some.records[0].accepted() == all.records[0].accepted());
  REQUIRE(some.records[0].accepted() > 0);
  CHECK(std::stoi(some.notes.front()) > 0);
  CHECK(std::stoi(some.notes.front()) < std::stoi(all.notes.front()));
}

TEST_CASE(
    "an argument that is misspelt, of the wrong type or out of range is named with its line") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"smooth{stpes = 4}", "smooth has no parameter 'stpes'; valid: on, cycles, laplacian"},
      {"smooth{steps = 'four'}", "smooth: steps must be a number, is 'four'"},
      {"smooth{laplacian = 1}", "smooth: laplacian must be true or false, is 1"},
      {"smooth{cycles = 0}", "smooth: cycles = 0 is outside 1 to 1000"},
      {"smooth{cycles = 1.5}", "smooth: cycles = 1.5 is not a whole number"},
      {"smooth{steps = 0}", "smoothing: steps = 0 is outside 1 to 1000"},
      {"smooth{4}", "smooth takes named arguments only: smooth{...}"},
      {"smooth(4)", "smooth takes named arguments in braces, not 4"},
      {"smooth{on = 'good'}", "smooth: on must be 'bad', 'all' or a table of conditions"},
      {"smooth{on = {bellow = 1}}", "smooth: on has no condition 'bellow'; valid: at_least, below"},
      {"smooth{on = {below = 200}}", "smooth: on: below = 200 is outside -100 to 100"},
      {"smooth{on = {worst = -1}}", "smooth: on: worst = -1 is outside 0 to"},
      {"smooth{on = {label = 1.5}}", "smooth: on: label = 1.5 is not a whole number"},
      {"smooth{on = {label = 'a'}}", "smooth: on: label must be a number or a list of numbers"},
      {"smooth{on = {box = {0, 0, 0}}}", "smooth: on: box must be {x_low, y_low, z_low, x_high"},
      {"smooth{on = {box = {1, 0, 0, 0, 1, 1}}}", "the lower corner is not below the upper one"},
      {"smooth{on = {property = 'heat'}}", "smooth: on: property must be {name, low = number"},
      {"smooth{on = {property = {'heat'}}}", "'heat'"},
      {"smooth{on = {property = {'min_sine', lo = 1}}}", "has no field 'lo'; valid: low, high"},
      {"local_reconnection{edges = 'magic'}", "unknown operator 'magic'; valid: shell_transform"},
      {"local_reconnection{edges = first_of{'edge_removal'}}", "must be one operator or false"},
      {"local_reconnection{edges = 'edge_removal', max_level = 3}",
       "local_reconnection has no parameter 'max_level'; valid: on, edges, faces, sweeps"},
      {"apply('magic')", "unknown operator 'magic'"},
      {"apply(3)", "apply must be an operator, first_of{...}, all_of{...} or sequence{...}, is 3"},
      {"apply({'edge_split', relaxed = true})",
       "edge_split has no parameter 'relaxed'; valid: order, most_edges, least_gain"},
      {"apply({'edge_split', order = 'best'})",
       "edge_split: order has no value 'best'; valid: sine, angle, longest, shortest"},
      {"apply({'edge_split', most_edges = 7})", "edge_split: most_edges = 7 is outside 1 to 6"},
      {"local_reconnection{edges = {'edge_removal', most_edges = 1.5}}",
       "edge_removal: most_edges = 1.5 is not a whole number"},
      {"apply(first_of{})", "apply: nothing to try"},
      {"apply(sequence{'smoothing'})", "apply: a sequence is an operator and what follows it"},
      {"apply(sequence{'smoothing', 'flip_2_3', desperate = 3})",
       "apply: desperate = 3 is outside"},
      {"apply(sequence{'smoothing', 'flip_2_3', theta_max = 60})",
       "apply: theta_max = 60 is outside"},
      {"apply(sequence{'smoothing', 'flip_2_3', desparate = 0.3})",
       "apply: sequence has no field 'desparate'; valid: desperate, theta_max"},
      {"apply(all_of{'smoothing', 'flip_2_3', desperate = 0.3})",
       "apply: all_of has no field 'desperate'"},
      {"apply('smoothing', {sweep = 3})", "apply has no parameter 'sweep'; valid: on, sweeps"},
      {"apply(function() end)", "a function is of no use here"},
      {"is_progress(quality(), 3)", "is_progress: now needs what quality() returns"},
      {"smooth{} parameter{'late', default = 1}", "parameter: to be declared before the first"},
      {"parameter{'x', default = 1, hihg = 3}", "parameter x has no field 'hihg'; valid: choices"},
      {"parameter{'x'}", "parameter x needs either a default or choices"},
      {"parameter{'x', default = 9, high = 3}", "parameter x: the default 9 is outside"},
      {"parameter{'a b', default = 1}", "'a b' is no name"},
      {"parameter{'x', default = 1} parameter{'x', default = 2}", "'x' exists already"},
      {"smoth{}", "unknown name 'smoth'; valid: adapt, all_of, apply"},
      {"io.open('/etc/passwd')", "unknown name 'io'"},
  };
  for (const auto& entry : cases) {
    const auto& script = entry.first;
    const auto& message = entry.second;
    CAPTURE(script);
    std::string second_line = "\n";
    second_line += script;
    const ScriptOutcome outcome = run_script(second_line);
    CHECK(outcome.error.starts_with("test.lua:2: "));
    CHECK_MESSAGE(contains(outcome.error, message), outcome.error);
  }
}

TEST_CASE("an error on the way leaves a sound mesh") {
  const ScriptOutcome outcome = run_script("local_reconnection{} smoth{}");
  CHECK(contains(outcome.error, "smoth"));
  CHECK(outcome.records.size() == 1);
  CHECK(check_integrity(outcome.mesh).empty());
}

TEST_CASE("parameters have defaults, and settings of the right type and range replace them") {
  const std::string script =
      "local n = parameter{'n', default = 3, low = 1, high = 9}\n"
      "local x = parameter{'x', default = 0.5, low = 0, high = 1}\n"
      "local on = parameter{'on', default = true}\n"
      "local how = parameter{'how', choices = {'slow', 'fast'}}\n"
      "log(n, x, on, how)";
  CHECK(run_script(script).notes.front() == "3 0.5 true slow");
  CHECK(run_script(script, {{"n", "7"}, {"x", "1e-1"}, {"on", "false"}, {"how", "fast"}})
            .notes.front() == "7 0.1 false fast");
  CHECK(run_script(script, {{"n", "7"}, {"n", "8"}}).notes.front() == "8 0.5 true slow");
  CHECK(contains(run_script(script, {{"m", "7"}}).error,
                 "has no parameter 'm'; valid: n, x, on, how"));
  CHECK(contains(run_script(script, {{"n", "10"}}).error, "n = 10 is outside 1 to 9"));
  CHECK(contains(run_script(script, {{"n", "2.5"}}).error, "n = 2.5 is not a whole number"));
  CHECK(contains(run_script(script, {{"n", "two"}}).error,
                 "n must be a number from 1 to 9, is 'two'"));
  CHECK(contains(run_script(script, {{"on", "1"}}).error, "on = 1: valid: true or false"));
  CHECK(contains(run_script(script, {{"how", "soon"}}).error, "how = soon: valid: slow, fast"));
  CHECK(
      contains(run_script("local x = 1", {{"m", "7"}}).error, "has no parameter 'm'; valid: none"));
}

TEST_CASE("a schedule describes itself without a mesh, up to its first pass") {
  const Schedule schedule(
      "test.lua",
      "description 'does little'\n"
      "local n = parameter{'n', default = 3, low = 1, high = 9, help = 'count'}\n"
      "smooth{cycles = n}\n"
      "parameter{'late', default = 1}");
  const ScheduleInfo info = schedule.describe();
  CHECK(info.description == "does little");
  REQUIRE(info.parameters.size() == 1);
  CHECK(info.parameters[0].name == "n");
  CHECK(info.parameters[0].range() == "1 to 9");
  CHECK(info.parameters[0].initial_text() == "3");
  CHECK(info.parameters[0].help == "count");
  CHECK_THROWS_AS(Schedule("test.lua", "descripton 'x'").describe(), Error);
  CHECK_NOTHROW(Schedule("test.lua", "while true do end").describe());
}

TEST_CASE("a run stops at its flag and at its time limit, also in an empty loop") {
  for (const char* script : {"while true do end", "while true do smooth{} end",
                             "while true do apply('smoothing', {on = 'all', again = true}) end"}) {
    CAPTURE(script);
    TetMesh mesh(delaunay_ball(150, 7));
    Run limited(mesh, kRegistry);
    limited.set_time_limit(0.05);
    CHECK_NOTHROW(improve(limited, Schedule("test.lua", script)));
    CHECK(limited.out_of_time());
    CHECK(limited.cancelled());
    CHECK(check_integrity(mesh).empty());
    Run stopped(mesh, kRegistry);
    const std::atomic<bool> stop = true;
    stopped.set_cancel_flag(&stop);
    CHECK_NOTHROW(improve(stopped, Schedule("test.lua", script)));
    CHECK_FALSE(stopped.out_of_time());
    CHECK(stopped.records.empty());
  }
}

TEST_CASE("a time limit stops a pass in its middle, and the mesh is sound and no worse") {
  TetMesh mesh(delaunay_ball(4000, 8));
  const double q_worst = quality_indicators(mesh).q_worst;
  Run run(mesh, kRegistry);
  run.set_time_limit(0.01);
  improve(run, Schedule("test.lua", "for i = 1, 100 do local_reconnection{} smooth{} end"));
  CHECK(run.out_of_time());
  CHECK(run.records.size() < 100);
  CHECK(check_integrity(mesh).empty());
  CHECK(quality_indicators(mesh).q_worst >= q_worst);
}

TEST_CASE("a script learns the mean of a ruler, and of the few tets that are worst") {
  TetMesh mesh(delaunay_ball(400, 3));
  std::vector<Quality> worst;
  for (const TetHandle t : live_tets(mesh)) {
    if (mesh.quality(t) < kBadThreshold) worst.push_back(mesh.quality(t));
  }
  REQUIRE(worst.size() > 32);
  std::sort(worst.begin(), worst.end());
  const double few = std::accumulate(worst.begin(), worst.begin() + 32, 0.0) / 32;
  const double radius = summarize(mesh, find_quality_measure("radius_ratio")).mean;
  Run run(mesh, kRegistry);
  improve(run, Schedule("test.lua", "log(quality().q_few) log(quality().radius_ratio)"));
  REQUIRE(run.notes.size() == 2);
  CHECK(std::stod(run.notes[0]) == doctest::Approx(few));
  CHECK(std::stod(run.notes[1]) == doctest::Approx(radius));
  // Of what may change: one that is protected hides no other. None is bad: 1.
  mesh.freeze([](TetHandle) { return true; });
  improve(run, Schedule("test.lua", "log(quality().q_few)"));
  CHECK(run.notes.back() == "1.0");
}

TEST_CASE("a script learns what the surface allows, and what holds its bad tets") {
  CHECK(note("limit().n_forced") == "0");
  CHECK(note("limit().n_bad") == "nil");
  const std::string sum =
      "(function(l) return l.surface + l.constraint + l.no_free_vertex + l.search end)(limit())";
  CHECK(note(sum + " == quality().n_bad and quality().n_bad > 0") == "true");

  MeshData flat = one_tet();
  for (Point& p : flat.points) p.z() *= 0.1;
  TetMesh mesh(flat);
  const SurfaceLimit limit = compute_surface_limit(mesh);
  Run run(mesh, kRegistry);
  improve(run, Schedule("test.lua",
                        "local l = limit() log(l.n_forced, l.surface, l.frozen) "
                        "log(l.q_worst) log(l.theta_min) log(l.theta_max)"));
  REQUIRE(run.notes.size() == 4);
  CHECK(run.notes[0] == "1 1 0");
  // As quality() has it: 1 is a tet that just meets the goal, not a sine.
  const double angle = std::asin(limit.q_worst.value()) * 180 / std::numbers::pi;
  CHECK(std::stod(run.notes[1]) == doctest::Approx(mesh.standard().quality_of_angle(angle)));
  CHECK(std::stod(run.notes[2]) == doctest::Approx(limit.theta_min.value()));
  CHECK(std::stod(run.notes[3]) == doctest::Approx(limit.theta_max.value()));
}

TEST_CASE("a script does what a built-in schedule does, with the parameters that it names") {
  const auto same = [](const ScriptOutcome& a, const ScriptOutcome& b) {
    return a.error.empty() && pass_names(a) == pass_names(b) && a.round == b.round &&
           a.mesh.tet_count() == b.mesh.tet_count();
  };
  const std::string shell(Schedule::builtin("shell").text());
  CHECK(same(run_script("run_schedule('shell')"), run_script(shell)));
  const ScriptOutcome once = run_script("run_schedule('shell', {max_rounds = 1, last_sweeps = 0})");
  CHECK(same(once, run_script(shell, {{"max_rounds", "1"}, {"last_sweeps", "0"}})));
  CHECK(once.round == 1);
  CHECK(contains(run_script("run_schedule('grummp', {mode = 'x'})").error,
                 "has no parameter 'mode'"));
  CHECK(contains(run_script("run_schedule('shell', {max_rounds = 0.5})").error, "max_rounds"));
  CHECK(contains(run_script("run_schedule('shell', {4})").error, "named parameters only"));
  CHECK(contains(run_script("run_schedule('test.lua')").error, "there is no schedule 'test.lua'"));
}

TEST_CASE("after hold_worst() no angle gets worse than the worst of the mesh was then") {
  /// Whether a tet with an angle of 0.01 degrees less than the smallest may come in.
  const auto admits_less = [](const std::string& script) {
    TetMesh mesh(delaunay_ball(150, 7));
    mesh.set_bounds(Bounds::of(mesh));
    Run run(mesh, kRegistry);
    improve(run, Schedule("test.lua", script));
    const MeshStatistics now = compute_statistics(mesh);
    const double turn = (now.theta_min - 0.01) * std::numbers::pi / 180;
    const Point wing(std::cos(turn), std::sin(turn), 0);
    return mesh.bounds().admit({0, 0, -0.5}, {0, 0, 0.5}, {1, 0, 0}, wing);
  };
  const std::string work = "local_reconnection{} smooth{} insert_points{} smooth{} ";
  CHECK(admits_less(work));
  CHECK_FALSE(admits_less(work + "hold_worst()"));
  CHECK_FALSE(admits_less(work + "hold_worst() judge_by{measure = 'sine'} goal{min = 20}"));
  CHECK(contains(run_script("hold_worst{1}").error, "hold_worst takes nothing"));
}

TEST_CASE("scripts see the operators that are registered") {
  CHECK(note("#operators()") == std::to_string(kRegistry.operators().size()));
  CHECK(note("operators()[1]") == std::string(kRegistry.operators()[0]->name));
}

TEST_CASE("a script that makes much of little for a word is stopped, also while it is described") {
  // Small in Lua, enormous when copied: tables and texts that are shared.
  const std::string tables =
      "local t = {'smoothing'} for d = 1, 14 do t = {t, t, t, t, t, t, t, t} end ";
  const std::string texts =
      "local s = 'x' for i = 1, 20 do s = s .. s end local t = {} for i = 1, 4000 do t[i] = s end ";
  for (const std::string& bomb : {tables, texts}) {
    for (const char* call : {"apply(t)", "smooth{on = t}", "attempt('smoothing', t)",
                             "run_schedule('shell', t)", "is_progress(t, t)"}) {
      CAPTURE(call);
      CHECK(contains(run_script(bomb + "begin_round() " + call).error, "take more than 64 MB"));
    }
    for (const char* call : {"description(t)", "parameter{'p', choices = t}", "parameter(t)"}) {
      CAPTURE(call);
      CHECK_THROWS_WITH_AS(
          Schedule("test.lua", bomb + call).describe(),
          "test.lua:1: arguments, notes, descriptions and records of passes take more than 64 MB",
          Error);
    }
  }
  CHECK_NOTHROW(Schedule("test.lua",
                         "local i = 0 while true do i = i + 1 parameter{'p' .. i, default = 1} end")
                    .describe());
}

TEST_CASE("notes come to an end, and show no control characters") {
  const ScriptOutcome flood =
      run_script("local s = 'x' for i = 1, 16 do s = s .. s end while true do log(s) end");
  CHECK(contains(flood.error, "take more than 64 MB"));
  std::size_t bytes = 0;
  for (const std::string& text : flood.notes) bytes += text.size();
  CHECK(bytes > (std::size_t{40} << 20));
  CHECK(bytes < (std::size_t{64} << 20));
  CHECK(note("'a\\27[2Jb\\n', 3, {}, log, nil, '\\255'") == "a\\x1b[2Jb\\n 3 table function nil ÿ");
  const ScheduleInfo info = Schedule("test.lua",
                                     "description 'a\\7b'\n"
                                     "parameter{'p', default = 1, help = '\\27[1m'}")
                                .describe();
  CHECK(info.description == "a\\x07b");
  CHECK(info.parameters.at(0).help == "\\x1b[1m");
  CHECK_THROWS_AS(Schedule("test.lua", "parameter{'p', choices = {'a\\27'}}").describe(), Error);
}

TEST_CASE("a script that never comes to a pass can be described, wherever it spends its time") {
  const std::string list = "local t = {} for i = 1, 50000 do t[i] = i end ";
  const std::string text = "local s = 'x' for i = 1, 21 do s = s .. s end ";
  for (const std::string& script :
       {list + "while true do table.sort(t) end",
        list + "while true do for k in pairs(t) do end end",
        list + "while true do table.insert(t, 1, 0) table.remove(t, 1) end",
        text + "while true do local u = s:upper() end",
        text + "local a, b = s .. 'a', s .. 'b' while true do local e = a < b end",
        text + "while true do local u = s .. 'x' end"}) {
    CAPTURE(script);
    CHECK_NOTHROW(Schedule("test.lua", script).describe());
    TetMesh mesh(delaunay_ball(150, 7));
    Run limited(mesh, kRegistry);
    limited.set_time_limit(0.02);
    CHECK_NOTHROW(improve(limited, Schedule("test.lua", "begin_round() " + script)));
    CHECK(limited.out_of_time());
  }
}
