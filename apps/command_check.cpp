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
#include <tetmend/improve.h>
#include <tetmend/io.h>
#include <tetmend/option_text.h>
#include <tetmend/rulers.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/improve_options.h"
#include "apps/mesh_formats.h"
#include "apps/number_check.h"
#include "apps/standard_streams.h"
#include "apps/threads.h"
#include "kernel/from_chars.h"
#include "kernel/printable.h"

namespace tetmend::apps {
namespace {

struct CheckCommand {
  std::filesystem::path file;
  std::filesystem::path improved;
  std::vector<std::filesystem::path> more;
  bool each = false;  ///< the meshes are not compared
  CheckOptions wanted;
  tetmend::Options run;               ///< its goal alone
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

nlohmann::json json_of(const Fact::Number& number) {
  if (const auto* count = std::get_if<std::uint64_t>(&number)) return *count;
  if (const auto* value = std::get_if<double>(&number)) return *value;
  return nullptr;
}

void say_whether(bool holds) {
  say(stdout, holds ? "ok" : "FAIL", holds ? Colour::green : Colour::red);
  say(stdout, holds ? "    " : "  ");
}

nlohmann::json json_of(const CheckCommand& options, const std::vector<Fact>& facts, bool holds) {
  nlohmann::json list = nlohmann::json::array();
  for (const Fact& fact : facts) {
    list.push_back({{"name", fact.name},
                    {"holds", fact.holds},
                    {"text", fact.text},
                    {"value", json_of(fact.value)},
                    {"wanted", json_of(fact.wanted)}});
  }
  nlohmann::json result = {
      {"schema", 1}, {"file", options.file.string()}, {"holds", holds}, {"facts", list}};
  if (!options.improved.empty()) result["improved"] = options.improved.string();
  return result;
}

void print(const CheckCommand& options, const std::vector<Fact>& facts, bool holds) {
  if (!options.json) {
    for (const Fact& fact : facts) {
      say_whether(fact.holds);
      say(stdout, printable(fact.text) + '\n');
    }
    const bool has_moved = options.wanted.surface.empty() &&
                           std::any_of(facts.begin(), facts.end(), [](const Fact& fact) {
                             return fact.name == "surface" && !fact.holds;
                           });
    if (has_moved) {
      say(stderr,
          "note: surfaces are compared bit for bit; of one that was let move, say how far, as that "
          "run had it: --surface 1%\n");
    }
    return;
  }
  print_json(json_of(options, facts, holds));
}

/// Of parts, groups are not kept: they cannot be compared.
Mesh load_to_check(const CheckCommand& options, const std::filesystem::path& file,
                   const pieces::ArrayFiles* parts) {
  Mesh mesh = load_whole(file, options.wanted.threads, parts);
  if (!parts->is_one(file)) return mesh;
  for (const std::string& text : mesh.notes()) {
    say(stderr, fmt::format("note: {}: {}\n", printable(file.string()), printable(text)));
  }
  return mesh;
}

/// @throws UsageError
std::vector<Fact> facts_of(CheckCommand& options, const pieces::ArrayFiles* parts) {
  CheckOptions& wanted = options.wanted;
  std::vector<Fact> facts;
  Mesh mesh = load_to_check(options, options.file, parts);
  try {
    if (!options.improved.empty()) {
      Mesh improved = load_to_check(options, options.improved, parts);
      facts =
          compare(mesh, improved, wanted.threads, wanted.preset, options.run.goal, wanted.surface);
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
  return facts;
}

bool all_hold(const std::vector<Fact>& facts) {
  return std::all_of(facts.begin(), facts.end(), [](const Fact& fact) { return fact.holds; });
}

/// The name of a mesh, and what does not hold.
void print_line(const CheckCommand& options, const std::vector<Fact>& facts) {
  if (options.json) {
    const nlohmann::json json = json_of(options, facts, all_hold(facts));
    return say(stdout, printable_for("standard output", json).dump() + '\n');
  }
  std::vector<std::string> failed;
  for (const Fact& fact : facts) {
    if (!fact.holds) failed.push_back(printable(fact.text));
  }
  say_whether(failed.empty());
  say(stdout, fmt::format("{}{}{}\n", shown(options.file), failed.empty() ? "" : ": ",
                          fmt::join(failed, "; ")));
}

/// A line for each of several meshes, and one for the worst. One that cannot be read is named, and
/// the others follow; the status is that of the worst.
int check_each(CheckCommand& options, const std::vector<std::filesystem::path>& files,
               const pieces::ArrayFiles* parts) {
  if (!options.wanted.asks()) {
    throw UsageError("several meshes are checked alike: give a threshold or --for PRESET");
  }
  for (const auto& file : files) check_input_format(file, parts);
  options.improved.clear();
  std::size_t unread = 0;
  std::size_t failing = 0;
  std::size_t most = 0;
  std::string worst;
  for (const auto& file : files) {
    options.file = file;
    try {
      const std::vector<Fact> facts = facts_of(options, parts);
      print_line(options, facts);
      const auto failed = static_cast<std::size_t>(
          std::count_if(facts.begin(), facts.end(), [](const Fact& fact) { return !fact.holds; }));
      if (failed > 0) ++failing;
      if (failed > most) worst = shown(file);
      most = std::max(most, failed);
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      ++unread;
      complain(kFailed, error.what());
    }
  }
  if (!options.json) {
    const std::size_t good = files.size() - failing - unread;
    say(stdout, fmt::format("{} of {} hold", grouped(good), grouped(files.size())));
    say(stdout, failing == 0 ? "\n"
                             : fmt::format("; the worst: {}, {} {}\n", worst, most,
                                           most == 1 ? "fact fails" : "facts fail"));
  }
  return unread > 0 ? kFailed : failing > 0 ? kGoalMissed : kSuccess;
}

int run_check(CheckCommand& options, const pieces::ArrayFiles* parts) {
  CheckOptions& wanted = options.wanted;
  for (const std::string& text : options.measures) wanted.measure.push_back(to_threshold(text));
  if (options.each || !options.more.empty()) {
    std::vector<std::filesystem::path> files = {options.file};
    if (!options.improved.empty()) files.push_back(options.improved);
    files.insert(files.end(), options.more.begin(), options.more.end());
    return check_each(options, files, parts);
  }
  name_streams(options.format, options.file, nullptr);
  check_input_format(options.file, parts);
  if (!options.improved.empty()) check_input_format(options.improved, parts);
  if (!wanted.asks() && options.improved.empty()) {
    throw UsageError(
        "nothing to check: give a threshold, --for PRESET or a second mesh (see tetmend check "
        "--help)");
  }
  if (!wanted.surface.empty() && options.improved.empty()) {
    throw UsageError("--surface: give the mesh that it became, too");
  }
  const std::vector<Fact> facts = facts_of(options, parts);
  print(options, facts, all_hold(facts));
  return all_hold(facts) ? kSuccess : kGoalMissed;
}

std::string preset_help() {
  std::string text;
  for (const CheckPreset& preset : check_presets())
    text += fmt::format("  {:<9} {}\n", preset.name, preset.source);
  return text;
}

void add_check_options(CLI::App& command, CheckCommand& options) {
  command.add_option("FILE", options.file, "Mesh")->required()->type_name("");
  command.add_option("OUT", options.improved, "What became of it: compared with FILE")
      ->type_name("");
  command
      .add_option("MORE", options.more, "Three meshes and more are not compared: each is checked")
      ->type_name("");
  command.add_flag("--each", options.each, "Check two meshes each, instead of comparing them");
  command
      .add_option("--min-dihedral", options.wanted.min_dihedral,
                  "No smaller dihedral angle; 0 to 71")
      ->type_name("DEGREES")
      ->check(number_from(0.0, 71.0));
  command
      .add_option("--max-dihedral", options.wanted.max_dihedral,
                  "No larger dihedral angle; 70 to 180")
      ->type_name("DEGREES")
      ->check(number_from(70.0, 180.0));
  command.add_flag("--no-inverted", options.wanted.no_inverted,
                   "No inverted or flat tet, in exact arithmetic, as the\nfile lists its vertices");
  command
      .add_option("--measure", options.measures,
                  "Worst value of a ruler of tetmend quality, such as\nmean_ratio=0.1; repeatable")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->take_all();
  command.add_option("--for", options.wanted.preset, "What a solver asks, see below")
      ->type_name("PRESET");
  add_goal_option(command, options.run);
  command
      .add_option("--surface", options.wanted.surface,
                  "How far the surface of OUT may have moved, as improve has\nit: proven both ways")
      ->type_name("flat|SHARE%|LENGTH");
  command.add_flag("--json", options.json,
                   "Print JSON (docs/check.schema.json); of several meshes a line each");
  add_format_option(command, options.format);
  add_threads_option(command, options.wanted.threads);
}

}  // namespace

void add_check(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<CheckCommand>();
  CLI::App* command = app.add_subcommand("check", "Prove what a mesh, or a result, promises");
  add_check_options(*command, *options);
  command->footer(fmt::format(
      R"(Prints a line for each fact. With two meshes, from the files alone: the same
surface, bit for bit, the same faces between labels, named triangles and groups,
the same other elements with all that tets share with them, the same volume of
each label, no inverted tet, no smaller theta_min, no larger theta_max unless
the goal allows it, not more bad tets: those of --goal, if the run had one.
Where inverted tets were mended, these two angles are shown and not asked for.
With --surface, what the surface is made of may have moved so far: each triangle
is proven to lie within that of what was there, wholly, and the other way round.
Thresholds are then asked of OUT, and --for explicit or implicit that OUT is no
dearer to solve on than FILE.

Of three meshes and more, or with --each, thresholds and --for are asked of each
one: a line each with what fails, one for the worst, and its status.

Presets; all of them ask for no inverted tet:
{}
Examples:
  tetmend check part.mesh --min-dihedral 15 --max-dihedral 165 --no-inverted
  tetmend check part.vtu --for openfoam --json
  tetmend check part.mesh better.mesh
  tetmend check --each --for fenicsx results/*.vtu

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
