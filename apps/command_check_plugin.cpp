// SPDX-License-Identifier: MIT
// tetmend check-plugin: holds the operators of a plugin to the contract of all operators.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/improve_options.h"
#include "apps/mesh_formats.h"
#include "apps/plugin_watch.h"
#include "apps/standard_streams.h"
#include "contract/contract.h"
#include "kernel/formats/tet_mesh_io.h"
#include "ops/plugin.h"

namespace tetmend::apps {
namespace {

struct CheckPluginOptions {
  std::filesystem::path plugin;
  std::vector<std::filesystem::path> meshes;
  double attempt_limit = 10;
};

/// An attempt is given up after so many times the limit.
constexpr double kPatience = 6;

std::vector<contract::Ground> load_grounds(const CheckPluginOptions& options) {
  std::vector<contract::Ground> grounds = contract::grounds();
  for (const std::filesystem::path& file : options.meshes) {
    grounds.push_back({file.string(), read_tet_mesh(file)});
  }
  return grounds;
}

/// True if the operator keeps its contract.
bool check_operator(const Registry& registry, std::string_view name,
                    const std::vector<contract::Ground>& grounds) {
  say(stdout, fmt::format("{}\n", name));
  const auto print_line = [](std::string_view mesh, const contract::Outcome& outcome) {
    const std::string_view what = !outcome.complaint.empty() ? "   BROKEN: "
                                  : !outcome.note.empty()    ? "   NOTE: "
                                                             : "";
    say(stdout, fmt::format("  {:<28} {:>8} attempts {:>7} accepted{}{}\n", mesh,
                            grouped(outcome.attempts), grouped(outcome.accepted), what,
                            outcome.complaint.empty() ? outcome.note : outcome.complaint));
    std::fflush(stdout);
  };
  contract::Outcome total;
  try {
    total = contract::check_contract(registry, name, grounds, print_line);
  } catch (const Error& error) {
    total.complaint = error.what();
  }
  const bool kept = total.complaint.empty();
  say(stdout,
      fmt::format("{} {} its contract: {} attempts, {} accepted{}{}\n\n", name,
                  kept ? "keeps" : "BREAKS", grouped(total.attempts), grouped(total.accepted),
                  kept && total.note.empty() ? "" : "; ", kept ? total.note : total.complaint));
  return kept;
}

int run_check_plugin(const CheckPluginOptions& options) {
  for (const std::filesystem::path& file : options.meshes) check_input_format(file, nullptr);
  Registry registry = Registry::builtin();
  const Plugin plugin = load_plugin(options.plugin, registry);
  note_crashes();
  const PluginWatch watch(
      {.attempt = options.attempt_limit, .longest = kPatience * options.attempt_limit},
      [](std::string_view text) { complain(kSuccess, text); });
  const std::vector<contract::Ground> grounds = load_grounds(options);
  std::size_t broken = 0;
  for (const OperatorInfo* info : plugin.operators) {
    if (!check_operator(registry, info->name, grounds)) ++broken;
  }
  if (broken == 0) return 0;
  throw Error(fmt::format("{}: {} of {} operators break{} the contract", options.plugin.string(),
                          broken, plugin.operators.size(), broken == 1 ? "s" : ""));
}

}  // namespace

void add_check_plugin(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<CheckPluginOptions>();
  CLI::App* command =
      app.add_subcommand("check-plugin", "Try the operators of a plugin on many meshes");
  command->add_option("FILE", options->plugin, "Shared library of the plugin")
      ->required()
      ->type_name("");
  command
      ->add_option("--mesh", options->meshes,
                   "Also try them on this mesh; may be repeated.\n"
                   "A large mesh is tried at fewer places")
      ->type_name("MESH")
      ->allow_extra_args(false);
  command
      ->add_option("--attempt-limit", options->attempt_limit,
                   "Say so when an attempt takes longer, and give up\n"
                   "after six times as long; 0: never (default: 10)")
      ->check(is_number_of_seconds)
      ->type_name("SECONDS");
  command->footer(
      R"(Holds every operator of the plugin to what the operators of tetmend keep, on
small meshes of all kinds that the program makes itself, with the parameters at
their defaults and at the ends of their ranges:

  a refusal leaves the mesh as it was, bit for bit
  an accepted attempt leaves a sound mesh with the same surface, volume, labels
  and constraints, and better qualities
  the same attempt always ends the same way, and can be undone
  nothing outside the part of the mesh given to a thread changes, nor does the
  operator ask for that
  no exceptions
  some attempts are accepted

One line for each mesh: attempts, accepted, the first breach. The line
"territory" is of all meshes once more, those of --mesh too, in parts as threads
get them; it says so where nothing was accepted there.

Example:
  tetmend check-plugin ./my_operator.so --mesh part.mesh

Exit status: 0 all contracts kept, 1 one is broken or the plugin cannot be
loaded, 2 wrong usage)");
  command->callback([options, &invocation] {
    invocation.action = [options] { return run_check_plugin(*options); };
  });
}

}  // namespace tetmend::apps
