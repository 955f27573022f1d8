// SPDX-License-Identifier: MIT
// tetmend check: does a mesh keep what a solver, or its input, asks of it?
//
//   of one mesh: thresholds of angles and measures, inverted tets, as asked for or as a preset says
//   of two: the same surface, walls, labels, volumes, groups, and nothing worse; computed from the
//   two files alone
#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <tetmend/io.h>
#include <tetmend/measure.h>

#include "apps/commands.h"
#include "apps/facts.h"
#include "apps/files.h"
#include "apps/threads.h"
#include "kernel/formats/mesh_io.h"

namespace tetmend::apps {
namespace {

struct Options {
  std::filesystem::path file;
  std::filesystem::path improved;
  double min_dihedral = 0;
  double max_dihedral = 180;
  bool no_inverted = false;
  std::vector<std::string> measures;  ///< NAME=VALUE
  std::string preset;
  bool json = false;
  int threads = 1;
  std::string format;
};

struct Preset {
  std::string_view name;
  std::string_view source;
  std::vector<std::pair<Ruler, double>> rulers;
  bool wants_markers = false;  ///< on all of the boundary
};

const std::vector<Preset>& presets() {
  static const std::vector<Preset> kPresets = {
      {"calculix", "ccx ends with status 201 at an element whose Jacobian is not positive", {}},
      {"fenicsx", "the Jacobian of an affine cell must not vanish, nor change its sign", {}},
      {"openfoam",
       "limits of checkMesh: non-orthogonality 70, skewness 4, aspect ratio 1000",
       {{Ruler::non_orthogonality, 70}, {Ruler::skewness, 4}, {Ruler::aspect_ratio, 1000}}},
      {"su2",
       "the dual volumes of a mesh must be positive, all of the boundary in markers",
       {},
       true}};
  return kPresets;
}

const Preset& find_preset(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Preset& preset : presets()) {
    if (preset.name == name) return preset;
    names.push_back(preset.name);
  }
  throw UsageError(
      fmt::format("--for: '{}' is no preset: expected one of {}", name, fmt::join(names, ", ")));
}

const RulerInfo& info(Ruler ruler) {
  return kRulers[static_cast<std::size_t>(ruler)];
}

std::pair<Ruler, double> to_threshold(const std::string& text) {
  const std::size_t equals = text.find('=');
  double value = 0;
  if (equals != std::string::npos) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + equals + 1, end, value);
    if (error == std::errc() && stop == end) {
      for (std::size_t i = 0; i < kRulerCount; ++i) {
        if (kRulers[i].name == text.substr(0, equals)) return {static_cast<Ruler>(i), value};
      }
    }
  }
  std::vector<std::string_view> names;
  for (const RulerInfo& each : kRulers) names.push_back(each.name);
  throw UsageError(
      fmt::format("--measure: '{}' is no threshold such as mean_ratio=0.1: expected one of {}",
                  text, fmt::join(names, ", ")));
}

std::vector<Fact> check_one(const Options& options) {
  const Mesh mesh = load(options.file, options.threads);
  std::vector<std::pair<Ruler, double>> thresholds;
  if (!options.preset.empty()) thresholds = find_preset(options.preset).rulers;
  for (const std::string& text : options.measures) thresholds.push_back(to_threshold(text));
  std::vector<Fact> facts;
  if (options.no_inverted || !options.preset.empty()) {
    facts.push_back(no_inverted(read_mesh(options.file)));
  }
  if (!options.preset.empty() && find_preset(options.preset).wants_markers) {
    facts.push_back(no_bare_boundary(read_mesh(options.file)));
  }
  const Measurement measured = measure(mesh, {.threads = options.threads});
  if (measured.curved && (options.no_inverted || !options.preset.empty())) {
    facts.push_back(at_most("turned_over", "curved tets turned over",
                            static_cast<double>(measured.curved->turned_over), 0));
  }
  if (options.min_dihedral > 0) {
    facts.push_back(at_least("theta_min", "smallest dihedral angle", measured.statistics.theta_min,
                             options.min_dihedral));
  }
  if (options.max_dihedral < 180) {
    facts.push_back(at_most("theta_max", "largest dihedral angle", measured.statistics.theta_max,
                            options.max_dihedral));
  }
  for (const auto& [ruler, wanted] : thresholds) {
    const RulerInfo& of = info(ruler);
    const std::string what = fmt::format("worst {}", of.title);
    const double worst = (*measured.rulers)[ruler].worst;
    facts.push_back(of.large_is_good ? at_least(std::string(of.name), what, worst, wanted)
                                     : at_most(std::string(of.name), what, worst, wanted));
  }
  return facts;
}

void print(const Options& options, const std::vector<Fact>& facts, bool holds) {
  if (!options.json) {
    for (const Fact& fact : facts) fmt::print("{}  {}\n", fact.holds ? "ok  " : "FAIL", fact.text);
    return;
  }
  nlohmann::json list = nlohmann::json::array();
  for (const Fact& fact : facts) {
    list.push_back({{"name", fact.name},
                    {"holds", fact.holds},
                    {"text", fact.text},
                    {"value", fact.value},
                    {"wanted", fact.wanted}});
  }
  nlohmann::json result = {
      {"schema", 1}, {"file", options.file.string()}, {"holds", holds}, {"facts", list}};
  if (!options.improved.empty()) result["improved"] = options.improved.string();
  fmt::print("{}\n", result.dump(2));
}

int run_check(Options& options) {
  name_streams(options.format, options.file, nullptr);
  check_mesh_extension(options.file);
  if (!options.improved.empty()) check_mesh_extension(options.improved);
  const bool asks = options.min_dihedral > 0 || options.max_dihedral < 180 || options.no_inverted ||
                    !options.measures.empty() || !options.preset.empty();
  if (!asks && options.improved.empty()) {
    throw UsageError(
        "nothing to check: give a threshold, --for PRESET or a second mesh (see tetmend check "
        "--help)");
  }
  std::vector<Fact> facts;
  if (!options.improved.empty())
    facts = compare_meshes(options.file, options.improved, options.threads);
  if (asks) {
    Options one = options;
    if (!options.improved.empty()) one.file = options.improved;
    for (Fact& fact : check_one(one)) facts.push_back(std::move(fact));
  }
  const bool holds =
      std::all_of(facts.begin(), facts.end(), [](const Fact& fact) { return fact.holds; });
  print(options, facts, holds);
  return holds ? kSuccess : kGoalMissed;
}

std::string preset_help() {
  std::string text;
  for (const Preset& preset : presets())
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
  command->add_option("--min-dihedral", options->min_dihedral, "No smaller dihedral angle")
      ->type_name("DEGREES")
      ->check(CLI::Range(0.0, 71.0));
  command->add_option("--max-dihedral", options->max_dihedral, "No larger dihedral angle")
      ->type_name("DEGREES")
      ->check(CLI::Range(70.0, 180.0));
  command->add_flag(
      "--no-inverted", options->no_inverted,
      "No inverted or flat tet, in exact arithmetic, as the\nfile lists its vertices");
  command
      ->add_option("--measure", options->measures,
                   "Worst value of a ruler of tetmend quality, such as\nmean_ratio=0.1; repeatable")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->take_all();
  command->add_option("--for", options->preset, "What a solver asks, see below")
      ->type_name("PRESET");
  command->add_flag("--json", options->json, "Print JSON (docs/check.schema.json)");
  add_format_option(*command, options->format);
  add_threads_option(*command, options->threads);
  command->footer(fmt::format(
      R"(Prints a line for each fact. With two meshes, from the files alone: the same
surface, bit for bit, the same faces between labels, named triangles and groups,
the same volume of each label, no inverted tet, no smaller theta_min, no larger
theta_max unless the goal allows it, not more bad tets. Thresholds are then
asked of OUT.

Presets; all of them ask for no inverted tet:
{}
Examples:
  tetmend check part.mesh --min-dihedral 15 --max-dihedral 165 --no-inverted
  tetmend check part.vtu --for openfoam --json
  tetmend check part.mesh better.mesh

Exit status: 0 all of it holds, 3 something does not, 1 a file cannot be read,
2 wrong usage)",
      preset_help()));
  command->callback(
      [options, &invocation] { invocation.action = [options] { return run_check(*options); }; });
}

}  // namespace tetmend::apps
