// SPDX-License-Identifier: MIT
// tetmend check: does a mesh keep what a solver, or its input, asks of it?
#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <tetmend/check.h>
#include <tetmend/io.h>
#include <tetmend/option_text.h>
#include <tetmend/rulers.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/mesh_formats.h"
#include "apps/standard_streams.h"
#include "apps/threads.h"
#include "kernel/from_chars.h"
#include "kernel/printable.h"

namespace tetmend::apps {
namespace {

struct Options {
  std::filesystem::path file;
  std::filesystem::path improved;
  CheckOptions wanted;
  std::vector<std::string> measures;  ///< NAME=VALUE
  bool json = false;
  std::string format;
};

/// @throws UsageError
std::pair<std::string, double> to_threshold(const std::string& text) {
  const std::size_t equals = text.find('=');
  double value = 0;
  if (equals != std::string::npos) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = from_chars(text.data() + equals + 1, end, value);
    const std::string name = text.substr(0, equals);
    const bool is_known = std::any_of(kRulers.begin(), kRulers.end(),
                                      [&](const RulerInfo& ruler) { return ruler.name == name; });
    if (is_known && error == std::errc() && stop == end) return {name, value};
  }
  std::vector<std::string_view> names;
  for (const RulerInfo& each : kRulers) names.push_back(each.name);
  throw UsageError(
      fmt::format("--measure: '{}' is no threshold such as mean_ratio=0.1: expected one of {}",
                  text, fmt::join(names, ", ")));
}

nlohmann::json to_json(const Fact::Number& number) {
  if (const auto* count = std::get_if<std::uint64_t>(&number)) return *count;
  if (const auto* value = std::get_if<double>(&number)) return *value;
  return nullptr;
}

void print(const Options& options, const std::vector<Fact>& facts, bool holds) {
  if (!options.json) {
    for (const Fact& fact : facts) {
      say(stdout, fmt::format("{}  {}\n", fact.holds ? "ok  " : "FAIL", printable(fact.text)));
    }
    return;
  }
  nlohmann::json list = nlohmann::json::array();
  for (const Fact& fact : facts) {
    list.push_back({{"name", fact.name},
                    {"holds", fact.holds},
                    {"text", fact.text},
                    {"value", to_json(fact.value)},
                    {"wanted", to_json(fact.wanted)}});
  }
  nlohmann::json result = {
      {"schema", 1}, {"file", options.file.string()}, {"holds", holds}, {"facts", list}};
  if (!options.improved.empty()) result["improved"] = options.improved.string();
  print_json(result);
}

/// Of parts, groups are not kept: they cannot be compared.
Mesh load_to_check(const Options& options, const std::filesystem::path& file,
                   const pieces::ArrayFiles* parts) {
  Mesh mesh = load_whole(file, options.wanted.threads, parts);
  if (!parts->is_one(file)) return mesh;
  for (const std::string& text : mesh.notes()) {
    say(stderr, fmt::format("note: {}: {}\n", printable(file.string()), printable(text)));
  }
  return mesh;
}

int run_check(Options& options, const pieces::ArrayFiles* parts) {
  name_streams(options.format, options.file, nullptr);
  check_input_format(options.file, parts);
  if (!options.improved.empty()) check_input_format(options.improved, parts);
  CheckOptions& wanted = options.wanted;
  for (const std::string& text : options.measures) wanted.measure.push_back(to_threshold(text));
  if (!wanted.asks() && options.improved.empty()) {
    throw UsageError(
        "nothing to check: give a threshold, --for PRESET or a second mesh (see tetmend check "
        "--help)");
  }
  std::vector<Fact> facts;
  Mesh mesh = load_to_check(options, options.file, parts);
  try {
    if (!options.improved.empty()) {
      Mesh improved = load_to_check(options, options.improved, parts);
      facts = compare(mesh, improved, wanted.threads, wanted.preset);
      mesh = std::move(improved);
    }
    if (wanted.asks()) {
      const auto& last = options.improved.empty() ? options.file : options.improved;
      const std::vector<Fact> asked = in_parts(last, parts, [&] { return check(mesh, wanted); });
      facts.insert(facts.end(), asked.begin(), asked.end());
    }
  } catch (const OptionError& error) {
    throw UsageError("--" + message_of(error));
  }
  const bool holds =
      std::all_of(facts.begin(), facts.end(), [](const Fact& fact) { return fact.holds; });
  print(options, facts, holds);
  return holds ? kSuccess : kGoalMissed;
}

std::string preset_help() {
  std::string text;
  for (const CheckPreset& preset : check_presets())
    text += fmt::format("  {:<9} {}\n", preset.name, preset.source);
  return text;
}

}  // namespace

void add_check(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("check", "Prove what a mesh, or a result, promises");
  command->add_option("FILE", options->file, "Mesh")->required()->type_name("");
  command->add_option("OUT", options->improved, "What became of it: compared with FILE")
      ->type_name("");
  command
      ->add_option("--min-dihedral", options->wanted.min_dihedral,
                   "No smaller dihedral angle; 0 to 71")
      ->type_name("DEGREES")
      ->check(CLI::Range(0.0, 71.0).description(""));
  command
      ->add_option("--max-dihedral", options->wanted.max_dihedral,
                   "No larger dihedral angle; 70 to 180")
      ->type_name("DEGREES")
      ->check(CLI::Range(70.0, 180.0).description(""));
  command->add_flag(
      "--no-inverted", options->wanted.no_inverted,
      "No inverted or flat tet, in exact arithmetic, as the\nfile lists its vertices");
  command
      ->add_option("--measure", options->measures,
                   "Worst value of a ruler of tetmend quality, such as\nmean_ratio=0.1; repeatable")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->take_all();
  command->add_option("--for", options->wanted.preset, "What a solver asks, see below")
      ->type_name("PRESET");
  command->add_flag("--json", options->json, "Print JSON (docs/check.schema.json)");
  add_format_option(*command, options->format);
  add_threads_option(*command, options->wanted.threads);
  command->footer(fmt::format(
      R"(Prints a line for each fact. With two meshes, from the files alone: the same
surface, bit for bit, the same faces between labels, named triangles and groups,
the same other elements with all that tets share with them, the same volume of
each label, no inverted tet, no smaller theta_min, no larger theta_max unless
the goal allows it, not more bad tets. Where inverted tets were mended, these
two angles are shown and not asked for. Thresholds are then asked of OUT, and
--for explicit or implicit that OUT is no dearer to solve on than FILE.

Presets; all of them ask for no inverted tet:
{}
Examples:
  tetmend check part.mesh --min-dihedral 15 --max-dihedral 165 --no-inverted
  tetmend check part.vtu --for openfoam --json
  tetmend check part.mesh better.mesh

{}
Exit status: 0 all of it holds, 3 something does not, 1 a file cannot be read,
2 wrong usage)",
      preset_help(), parts_help()));
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] {
      return run_check(*options, invocation.array_files);
    };
  });
}

}  // namespace tetmend::apps
