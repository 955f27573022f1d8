// SPDX-License-Identifier: MIT
// Plugins as a user of the command line has them.
#include <cstdlib>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"
#include "tests/support/plugin_file.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

constexpr const char* kVariable = "TETMEND_PLUGIN_PATH";

/// An environment variable of the program while this lives.
class Setting {
 public:
  explicit Setting(const std::string& value) { ::setenv(kVariable, value.c_str(), 1); }
  ~Setting() { ::unsetenv(kVariable); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;
};

/// One line on stderr, from tetmend.
void check_one_line(const test::Outcome& outcome, int status) {
  CAPTURE(outcome.err);
  CHECK(outcome.status == status);
  CHECK(outcome.err.starts_with("tetmend: "));
  CHECK(count_of(outcome.err, "\n") == 1);
}

}  // namespace

TEST_CASE("operators of plugins are listed with their file, as often as --plugin is given") {
  const test::Outcome outcome = run_program(
      {"operators", "--plugin", plugin_file("sound"), "--plugin", plugin_file("odt_smoothing")});
  CHECK(outcome.err.empty());
  CHECK(outcome.status == 0);
  CHECK(contains(outcome.out, "sound\n  target: vertex"));
  CHECK(contains(outcome.out, "  plugin: " + plugin_file("sound")));
  CHECK(contains(outcome.out, "odt_smoothing\n"));
  CHECK(contains(outcome.out, "halvings"));
  CHECK(count_of(outcome.out, "  plugin: ") == 2);
  const test::Outcome one = run_program({"operators", "--plugin", plugin_file("sound"), "sound"});
  CHECK(one.status == 0);
  CHECK(one.out.starts_with("sound\n"));
}

TEST_CASE("TETMEND_PLUGIN_PATH names files and folders, and each plugin is loaded once") {
  const TempFolder folder;
  std::filesystem::copy_file(plugin_file("odt_smoothing"), folder / "b.so");
  std::filesystem::copy_file(plugin_file("sound"), folder / "a.so");
  write_text(folder / "readme.txt", "no plugin");
  {
    const Setting setting((folder / "").string() + "::" + (folder / "a.so").string());
    const test::Outcome outcome =
        run_program({"operators", "--plugin", (folder / "b.so").string()});
    CHECK(outcome.err.empty());
    CHECK(outcome.status == 0);
    CHECK(count_of(outcome.out, "  plugin: ") == 2);
    CHECK(outcome.out.find("sound\n") < outcome.out.find("odt_smoothing\n"));
  }
  const Setting setting((folder / "nowhere").string());
  const test::Outcome outcome = run_program({"operators"});
  check_one_line(outcome, 1);
  CHECK(contains(outcome.err, "TETMEND_PLUGIN_PATH"));
  CHECK(contains(outcome.err, (folder / "nowhere").string()));
}

TEST_CASE("a plugin that cannot be loaded stops each command before it works") {
  const TempFolder folder;
  const std::string broken = plugin_file("other_version");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"operators", "--plugin", broken},
        {"schedules", "--plugin", broken},
        {"improve", "missing.mesh", "-o", (folder / "out.mesh").string(), "--plugin", broken},
        {"check-plugin", broken}}) {
    const test::Outcome outcome = run_program(arguments);
    check_one_line(outcome, 1);
    CHECK(contains(outcome.err, "plugin ABI"));
    CHECK(outcome.out.empty());
  }
  CHECK(folder.entries() == 0);
}

TEST_CASE("a schedule uses a plugin's operator by its name") {
  const TempFolder folder;
  const std::string mesh = std::string(TETMEND_SOURCE_DIR) + "/assets/meshes/sheet.mesh";
  const std::string script = (folder / "mine.lua").string();
  const std::string report = (folder / "report.json").string();
  write_text(script, "apply({\"odt_smoothing\", halvings = 4}, {on = {below = 0.6}})\n");
  const test::Outcome outcome = run_program({"improve", "--plugin", plugin_file("odt_smoothing"),
                                             mesh, "-o", (folder / "out.mesh").string(),
                                             "--schedule", script, "--report", report, "--quiet"});
  CHECK(outcome.err.empty());
  REQUIRE(outcome.status == 0);
  const auto passes = nlohmann::json::parse(read_text(report))["passes"];
  REQUIRE(passes.size() == 1);
  CHECK(passes[0]["accepted"] > 0);
  // Without the plugin there is no such operator.
  const test::Outcome without =
      run_program({"improve", mesh, "-o", (folder / "other.mesh").string(), "--schedule", script});
  check_one_line(without, 1);
  CHECK(contains(without.err, "unknown operator 'odt_smoothing'"));
}

TEST_CASE("an operator that throws ends the program with its name, and no output is touched") {
  const TempFolder folder;
  const std::string mesh = std::string(TETMEND_SOURCE_DIR) + "/assets/meshes/bracket.meshb";
  const std::string script = (folder / "mine.lua").string();
  const std::string out = (folder / "out.mesh").string();
  const std::string plugin = plugin_file("throwing");
  for (const std::string threads : {"1", "3"}) {
    for (const std::string name : {"throws_in_evaluate", "throws_in_apply", "throws_when_made"}) {
      CAPTURE(name);
      write_text(out, "dear to me");
      write_text(script, "local_reconnection{}\napply(\"" + name + "\")\n");
      const test::Outcome outcome = run_program({"improve", mesh, "-o", out, "--plugin", plugin,
                                                 "--schedule", script, "--threads", threads});
      check_one_line(outcome, 1);
      CHECK(outcome.out.empty());
      CHECK(contains(outcome.err, "operator '" + name + "' of " + plugin));
      CHECK(read_text(out) == "dear to me");
      CHECK(folder.entries() == 2);
    }
  }
}

TEST_CASE("check-plugin has a line for each mesh, also the user's, and status 0 for a sound one") {
  const std::string mesh = std::string(TETMEND_SOURCE_DIR) + "/assets/meshes/two_materials.mesh";
  const test::Outcome outcome = run_program({"check-plugin", plugin_file("sound"), "--mesh", mesh});
  CAPTURE(outcome.out);
  CHECK(outcome.err.empty());
  CHECK(outcome.status == 0);
  for (const std::string name : {"one_tet", "ball_200", "constrained_ball", "territory"}) {
    CHECK(contains(outcome.out, "\n  " + name + " "));
  }
  CHECK(contains(outcome.out, "\n  " + mesh + " "));
  CHECK(contains(outcome.out, "sound keeps its contract: "));
  CHECK(!contains(outcome.out, "BROKEN"));
}

TEST_CASE("check-plugin says what is wrong with each operator and ends with status 1") {
  const test::Outcome outcome = run_program({"check-plugin", plugin_file("lying")});
  CAPTURE(outcome.out);
  check_one_line(outcome, 1);
  CHECK(contains(outcome.err, "7 of 8 operators break the contract"));
  CHECK(contains(outcome.out, "edits_in_evaluate BREAKS its contract"));
  CHECK(contains(outcome.out, "makes_it_worse keeps its contract"));  // attempt() sees to that
  CHECK(contains(outcome.out, "changes_its_mind BREAKS its contract"));
  CHECK(contains(outcome.out, "cannot be made: its function made nothing"));
}

TEST_CASE("wrong usage of check-plugin is status 2") {
  check_one_line(run_program({"check-plugin"}), 2);
  const std::string plugin = plugin_file("sound");
  check_one_line(run_program({"check-plugin", plugin, "--mesh", plugin}), 2);  // is no mesh
  check_one_line(run_program({"check-plugin", plugin, "--mesh", "nowhere.stl"}), 1);
  check_one_line(run_program({"check-plugin", plugin_file("sound"), "more"}), 2);
}
