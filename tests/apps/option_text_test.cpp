// SPDX-License-Identifier: MIT
// Options as text: the library and the command line know the same, and say the same of mistakes.
#include <algorithm>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tetmend/option_text.h>

#include "tests/apps/program.h"
#include "tests/support/assets.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// What the library says of an option; empty: nothing.
std::string message_of_library(const std::string& name, const std::string& value) {
  try {
    Options options;
    set_option(options, name, value);
    check(options);
  } catch (const OptionError& error) {
    return message_of(error);
  }
  return {};
}

}  // namespace

TEST_CASE(
    "the library knows the options of 'tetmend improve' and 'tetmend adapt' by name, and takes the "
    "same") {
  const std::string help =
      run_program({"improve", "--help"}).out + run_program({"adapt", "--help"}).out;
  // Those that are about files, the terminal, pieces, and the program's watch over plugins.
  const std::set<std::string> of_the_program = {
      "help",   "output",  "report",  "quiet",      "strict",    "label-array",
      "format", "variant", "verbose", "dry-run",    "no-config", "attempt-limit",
      "pieces", "memory",  "scratch", "checkpoint", "for"};
  const std::set<std::string> of_the_library = {"script", "limit"};
  std::set<std::string> names;
  const std::regex option(R"(\n +(?:-\w,\s*)?--([a-z-]+))");
  for (std::sregex_iterator each(help.begin(), help.end(), option), end; each != end; ++each) {
    names.insert((*each)[1].str());
  }
  REQUIRE(names.size() > 20);
  for (const OptionForm& form : option_forms()) {
    const std::string name(form.name);
    CAPTURE(name);
    CHECK(names.contains(name) != of_the_library.contains(name));
    if (form.value != "true|false" && names.contains(name)) {
      CHECK(help.find("--" + name + " " + std::string(form.value)) != std::string::npos);
    }
    names.erase(name);
  }
  for (const std::string& name : names) {
    CAPTURE(name);
    CHECK(of_the_program.contains(name));
  }
}

TEST_CASE("help says of an option of the library what its row says, and the manual has it") {
  std::string help = run_program({"improve", "--help"}).out + run_program({"adapt", "--help"}).out;
  help = std::regex_replace(help, std::regex("\\s+"), " ");
  const std::string manual =
      read_text(std::filesystem::path(TETMEND_SOURCE_DIR) / "docs" / "library.md");
  std::set<std::string_view> names;
  for (const OptionForm& form : option_forms()) names.insert(form.name);
  for (const OptionForm& form : option_forms()) {
    CAPTURE(form.name);
    CHECK(!form.help.empty());
    CHECK((form.needs.empty() || names.contains(form.needs)));
    const bool is_of_no_command = form.name == "script" || form.name == "limit";
    CHECK((form.group == OptionGroup::other) == is_of_no_command);
    std::string field(form.name);
    std::replace(field.begin(), field.end(), '-', '_');
    CHECK(manual.find("`" + field + "`") != std::string::npos);
    if (is_of_no_command) continue;
    const std::string_view begin = form.help.substr(0, form.help.size() - 1);  // may go on
    CHECK(help.find(begin) != std::string::npos);
    if (!form.initial.empty())
      CHECK(help.find("default: " + std::string(form.initial)) != std::string::npos);
  }
}

TEST_CASE("of a wrong value the command line says what the library says") {
  const std::vector<std::array<std::string, 2>> wrong = {{"schedule", "varnish"},
                                                         {"set", "rounds"},
                                                         {"set", "=3"},
                                                         {"set", "polish=1"},
                                                         {"goal", "3x"},
                                                         {"goal", "20,"},
                                                         {"goal", "80"},
                                                         {"measure", "beauty"},
                                                         {"time-limit", "0"},
                                                         {"time-limit", "soon"},
                                                         {"time-limit", "1e10"},
                                                         {"threads", "0"},
                                                         {"threads", "1025"},
                                                         {"threads", "3.5"},
                                                         {"threads", "many"},
                                                         {"protect", "lable:1"},
                                                         {"only", "box:0,0"},
                                                         {"layers", "drop"},
                                                         {"surface", "soft"},
                                                         {"surface", "-1%"},
                                                         {"surface", "101%"},
                                                         {"feature-angle", "0"},
                                                         {"feature-angle", "x"},
                                                         {"tets", "some"},
                                                         {"trace-around", "here"},
                                                         {"trace-operator", "polish"},
                                                         {"trace-depth", "-1"},
                                                         {"trace-depth", "1001"},
                                                         {"trace-limit", "5Q"},
                                                         {"trace-limit", "0"},
                                                         {"trace-limit", "500"}};
  const TempFolder folder;
  for (const auto& entry : wrong) {
    const std::string& name = entry[0];
    const std::string& value = entry[1];
    CAPTURE(name);
    CAPTURE(value);
    const std::string expected = message_of_library(name, value);
    CHECK(expected.starts_with(name));
    std::vector<std::string> arguments = {"improve", asset("two_materials.mesh"), "-o",
                                          (folder / "out.mesh").string(),
                                          "--" + name + "=" + value};
    if (name.starts_with("trace-")) {
      arguments.push_back("--trace");
      arguments.push_back((folder / "run.trace").string());
    }
    if (name == "feature-angle") arguments.push_back("--surface=flat");
    const Outcome outcome = run_program(arguments);
    CHECK(outcome.status == 2);
    const std::string line = outcome.err.substr(0, outcome.err.find('\n'));
    const std::string plain = "tetmend: --" + expected;
    const bool is_same = line == plain || line == plain + " (see tetmend improve --help)";
    CHECK_MESSAGE(is_same, line, " instead of ", plain);
  }
  CHECK(folder.entries() == 0);
}

TEST_CASE("an option that does nothing without another asks for it") {
  const TempFolder folder;
  for (const auto& [name, value, needed] : std::vector<std::array<std::string, 3>>{
           {"feature-angle", "30", "surface"}, {"trace-depth", "1", "trace"}}) {
    const Outcome outcome = run_program({"improve", asset("two_materials.mesh"), "-o",
                                         (folder / "out.mesh").string(), "--" + name, value});
    CHECK(outcome.status == 2);
    CHECK(outcome.err ==
          "tetmend: --" + name + " requires --" + needed + " (see tetmend improve --help)\n");
  }
  CHECK(folder.entries() == 0);
}

TEST_CASE("options as text are those of C++") {
  Options options;
  const std::vector<std::array<std::string, 2>> all = {
      {"schedule", "thorough"}, {"script", "smooth{}"},
      {"set", "a=b=c"},         {"set", "d="},
      {"goal", "35"},           {"measure", "sine"},
      {"purpose", "explicit"},  {"time-limit", "1.5"},
      {"plugin", "a.so"},       {"check-operators", ""},
      {"threads", "8"},         {"protect", "label:1"},
      {"only", "label:2"},      {"layers", "improve"},
      {"tets", "10%"},          {"surface", "1%"},
      {"feature-angle", "30"},  {"keep-size", "true"},
      {"ignore-interior", ""},  {"conserve", "density"},
      {"trace", "a.trace"},     {"trace-around", "7"},
      {"trace-operator", "x"},  {"trace-depth", "0"},
      {"trace-limit", "5K"},    {"trace-piece", "2:3"},
      {"limit", "true"},        {"straighten", ""},
      {"size", "0.5x"},         {"gradation", "1.2"},
      {"smallest", "0.01"},     {"largest", "2"}};
  for (const auto& [name, value] : all) set_option(options, name, value);
  CHECK(options.schedule == "thorough");
  CHECK(options.script == "smooth{}");
  REQUIRE(options.set.size() == 2);
  CHECK(options.set[0] == std::pair<std::string, std::string>("a", "b=c"));
  CHECK(options.set[1].second.empty());
  CHECK(options.goal == Goal{35, 145});
  set_option(options, "goal", "30,140");
  CHECK(options.goal == Goal{30, 140});
  CHECK(options.measure == "sine");
  CHECK(options.time_limit == 1.5);
  CHECK(options.plugin == std::vector<std::filesystem::path>{"a.so"});
  CHECK(options.check_operators);
  CHECK(options.threads == 8);
  CHECK(options.protect == std::vector<std::string>{"label:1"});
  CHECK(options.only == std::vector<std::string>{"label:2"});
  CHECK(options.layers == Layers::improve);
  CHECK(options.tets == "10%");
  CHECK(options.surface == "1%");
  CHECK(options.feature_angle == 30);
  CHECK(options.keep_size);
  CHECK(options.ignore_interior);
  CHECK(options.straighten);
  CHECK(options.conserve == std::vector<std::string>{"density"});
  CHECK(options.trace == "a.trace");
  CHECK(options.trace_piece == "2:3");
  CHECK(options.trace_around == "7");
  CHECK(options.trace_operator == std::vector<std::string>{"x"});
  CHECK(options.trace_depth == 0);
  CHECK(options.trace_limit == 5000);
  CHECK(options.limit);
  CHECK(options.size == std::vector<std::string>{"0.5x"});
  CHECK(options.gradation == 1.2);
  CHECK(options.smallest == 0.01);
  CHECK(options.largest == 2);
  set_option(options, "limit", "false");
  CHECK_FALSE(options.limit);
  for (const OptionForm& form : option_forms()) {
    CHECK(std::any_of(all.begin(), all.end(),
                      [&](const auto& entry) { return entry[0] == form.name; }));
  }
}
