// SPDX-License-Identifier: MIT
// Schedules from the command line: scripts of users with and without mistakes.
#include <csignal>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "schedule/lua_state.h"
#include "schedule/schedule.h"
#include "tests/apps/program.h"
#include "tests/support/assets.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// One line on stderr, as every error has it.
bool is_complaint(const Outcome& outcome) {
  return outcome.err.starts_with("tetmend: ") && outcome.err.back() == '\n' &&
         outcome.err.find('\n') == outcome.err.size() - 1;
}

struct ScheduleBench {
  TempFolder folder;
  std::string script = (folder / "my.lua").string();
  std::string out = (folder / "out.mesh").string();

  std::string in = asset("sheet.mesh");

  Outcome improve(const std::string& text, std::vector<std::string> more = {}) {
    write_text(script, text);
    std::vector<std::string> arguments = {"improve", in, "-o", out, "--schedule", script};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }
};

}  // namespace

TEST_CASE("scripts with mistakes end with status 1, name line and word, and touch no file") {
  const std::vector<std::pair<std::string, std::string>> scripts = {
      {"-- a comment\nsmoth{}", "my.lua:2: unknown name 'smoth'; valid: "},
      {"smooth{", "my.lua:1: "},
      {"smooth{} smooth{stpes = 3}", "my.lua:1: smooth has no parameter 'stpes'; valid: on, "},
      {"smooth{cycles = 'many'}", "my.lua:1: smooth: cycles must be a number, is 'many'"},
      {"local function f() return 1 + f() end\nf()", "my.lua:1: stack overflow"},
      {"local t = {} while true do t[#t + 1] = {} end", "my.lua:1: the script holds more than"},
      {"local s = 'x' while true do s = s .. s end", "my.lua:1: a text is longer than 4 MB"},
      {"error('\\27[2J\\nwritten')", "my.lua:1: \\x1b[2J\\nwritten"},
      {"log(string.format('%p', {}))", "my.lua:1: string.format: %p is an address"},
      {"io.open('/etc/passwd')", "my.lua:1: unknown name 'io'"},
      {"os.execute('true')", "my.lua:1: unknown name 'os'"},
      {"require 'os'", "my.lua:1: unknown name 'require'"},
      {"\x1bLua", "my.lua: attempt to load a binary chunk"},
  };
  ScheduleBench bench;
  const std::string input = read_text(asset("sheet.mesh"));
  write_text(bench.out, "earlier output\n");
  for (const auto& entry : scripts) {
    const auto& script = entry.first;
    const auto& message = entry.second;
    CAPTURE(script);
    const Outcome outcome = bench.improve(script);
    CHECK(outcome.status == 1);
    CHECK(is_complaint(outcome));
    CHECK_MESSAGE(contains(outcome.err, message), outcome.err);
    CHECK(read_text(bench.out) == "earlier output\n");
    CHECK(bench.folder.entries() == 2);
  }
  CHECK(read_text(asset("sheet.mesh")) == input);
}

TEST_CASE("wrong settings and limits are wrong usage, before any work") {
  ScheduleBench bench;
  const std::string script = "local n = parameter{'n', default = 3, low = 1, high = 9} smooth{}";
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--set", "m=1"}, "has no parameter 'm'; valid: n"},
      {{"--set", "n=10"}, "n = 10 is outside 1 to 9"},
      {{"--set", "n=many"}, "n must be a number from 1 to 9, is 'many'"},
      {{"--set", "n"}, "'n' is not of the form NAME=VALUE"},
      {{"--set", "=1"}, "'=1' is not of the form NAME=VALUE"},
      {{"--time-limit", "0"}, "--time-limit"},
      {{"--time-limit", "soon"}, "--time-limit"},
      {{"--attempt-limit", "nan"}, "--attempt-limit: 'nan' is not a number of seconds from 0"},
  };
  for (const auto& [options, message] : wrong) {
    const Outcome outcome = bench.improve(script, options);
    CAPTURE(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(is_complaint(outcome));
    CHECK(contains(outcome.err, message));
  }
  CHECK(bench.folder.entries() == 1);
  const Outcome missing = run_program(
      {"improve", asset("sheet.mesh"), "-o", bench.out, "--schedule", "/nowhere/my.lua"});
  CHECK(missing.status == 1);
  CHECK(contains(missing.err, "/nowhere/my.lua: cannot read it"));
}

TEST_CASE("a script runs with its settings, and report and notes tell it") {
  ScheduleBench bench;
  const std::string report = (bench.folder / "r.json").string();
  const Outcome outcome = bench.improve(
      "local n = parameter{'n', default = 1, low = 1, high = 9}\n"
      "for i = 1, n do begin_round() local_reconnection{} end log('rounds', n)",
      {"--set", "n=3", "--report", report});
  CHECK(outcome.status == 0);
  CHECK(contains(outcome.out, "rounds 3"));
  const auto json = nlohmann::json::parse(read_text(report));
  CHECK(json["schedule"] == bench.script);
  CHECK(json["settings"]["n"] == "3");
  CHECK(json["notes"][0] == "rounds 3");
  CHECK(json["passes"].size() == 3);
  CHECK(json["passes"][2]["round"] == 3);
  CHECK(json["out_of_time"] == false);
}

TEST_CASE("a time limit ends an endless script with status 0 and a written mesh") {
  ScheduleBench bench;
  const std::string report = (bench.folder / "r.json").string();
  const Outcome outcome =
      bench.improve("smooth{} while true do end", {"--time-limit", "0.2", "--report", report});
  CHECK(outcome.status == 0);
  CHECK(contains(outcome.out, "stopped by the time limit"));
  CHECK(nlohmann::json::parse(read_text(report))["out_of_time"] == true);
  CHECK(run_program({"quality", bench.out}).status == 0);
}

TEST_CASE("Ctrl-C ends an endless script with status 1 and a written mesh") {
  ScheduleBench bench;
  write_text(bench.script, "log 'looping' while true do end");
  Terminal user;
  const Program program(
      {"improve", asset("sheet.mesh"), "-o", bench.out, "--schedule", bench.script},
      bench.folder / "stdout", user.slave());
  user.wait_for("looping");
  program.send(SIGINT);
  CHECK(program.wait() == 4);
  CHECK(run_program({"quality", bench.out}).status == 0);
}

TEST_CASE("the default schedule is shell.lua, by name and by file") {
  ScheduleBench bench;
  const auto result = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"improve", asset("sheet.mesh"), "-o", bench.out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    CHECK(run_program(arguments).status == 0);
    return read_text(bench.out);
  };
  const std::string by_default = result({});
  CHECK(by_default == result({"--schedule", "shell"}));
  const std::string source = std::string(TETMEND_SOURCE_DIR) + "/assets/schedules/shell.lua";
  CHECK(by_default == result({"--schedule", source}));
  CHECK(run_program({"schedules", "shell", "--source"}).out == read_text(source));
}

TEST_CASE("schedules are listed with description and parameters") {
  const Outcome all = run_program({"schedules"});
  CHECK(all.status == 0);
  CHECK(contains(all.out, "shell (default)"));
  for (const std::string_view name : builtin_schedule_names()) {
    CHECK(contains(all.out, std::string(name)));
    const Outcome one = run_program({"schedules", std::string(name)});
    CHECK(one.status == 0);
    for (const ScheduleParameter& parameter : Schedule::builtin(name).describe().parameters) {
      CHECK(contains(one.out, parameter.name));
    }
  }
  CHECK(contains(run_program({"schedules", "--words"}).out, "local_reconnection{...}"));
}

TEST_CASE("docs/schedules.md is what the program says") {
  const std::string page = read_text(std::string(TETMEND_SOURCE_DIR) + "/docs/schedules.md");
  const std::string begin = "<!-- generated: tetmend schedules --markdown -->\n";
  const std::string end = "<!-- end of the generated part -->\n";
  REQUIRE(contains(page, begin));
  REQUIRE(contains(page, end));
  const std::size_t first = page.find(begin) + begin.size();
  // To put it right: replace what stands between the marks by the output of the command.
  CHECK(page.substr(first, page.find(end) - first) == run_program({"schedules", "--markdown"}).out);
}

TEST_CASE("the limits that docs/schedules.md names are those of the box") {
  const std::string page = read_text(std::string(TETMEND_SOURCE_DIR) + "/docs/schedules.md");
  const LuaState::Limits limits;
  const auto megabytes = [](std::size_t bytes) { return std::to_string(bytes >> 20) + " MB"; };
  CHECK(contains(page, "| all that the script holds | " + megabytes(limits.memory) + ";"));
  CHECK(contains(page, "| one text | " + megabytes(limits.text) + " |"));
  CHECK(contains(page, "the arguments of one call | " + megabytes(limits.outside) + " |"));
}

TEST_CASE("the examples of docs/schedules.md run") {
  const std::string page = read_text(std::string(TETMEND_SOURCE_DIR) + "/docs/schedules.md");
  const std::string begin = "```lua\n";
  std::vector<std::string> examples;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    examples.push_back(page.substr(at, page.find("```", at) - at));
  }
  REQUIRE(examples.size() == 4);
  ScheduleBench bench;
  const Outcome rounds = bench.improve(examples[0]);
  CHECK(rounds.status == 0);
  CHECK(contains(rounds.out, "bad tets, smallest angle"));
  const Outcome goal = bench.improve(examples[1], {"--set", "min_dihedral=20"});
  CHECK(goal.status == 0);
  CHECK(!contains(goal.out, "the surface allows"));
  CHECK(contains(goal.out, "of 20\n"));
  CHECK(bench.improve(examples[2]).status == 0);
  CHECK(bench.improve(examples[3]).status == 0);
  bench.in = std::string(TETMEND_SOURCE_DIR) + "/assets/meshes/folded_sheet.mesh";
  const Outcome beyond = bench.improve(examples[1], {"--set", "min_dihedral=30"});
  CHECK(contains(beyond.out, "the surface allows"));
}
