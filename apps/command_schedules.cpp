// SPDX-License-Identifier: MIT
// tetmend schedules: the schedules that there are, their parameters, and the language they are
// written in.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tetmend/catalogue.h>

#include "apps/commands.h"
#include "apps/plugins.h"
#include "apps/standard_streams.h"
#include "schedule/reference.h"

namespace tetmend::apps {
namespace {

struct SchedulesOptions {
  std::string name;
  std::vector<std::filesystem::path> plugins;
  bool source = false;
  bool words = false;
  bool markdown = false;
};

int run_schedules(const SchedulesOptions& options) {
  tetmend::operators(all_plugins(options.plugins));  // one that cannot be loaded is found here, too
  if (options.markdown) {
    say(stdout, format_reference());
    return 0;
  }
  if (options.words) {
    say(stdout, format_words());
    return 0;
  }
  if (options.name.empty()) {
    for (const ScheduleInfo& info : schedules()) say(stdout, format_summary(info));
    return 0;
  }
  try {
    say(stdout, options.source ? schedule_source(options.name)
                               : format_parameters(describe_schedule(options.name)));
  } catch (const Error& error) {
    if (std::filesystem::path(options.name).extension() == ".lua") throw;
    throw UsageError(error.what());
  }
  return 0;
}

}  // namespace

void add_schedules(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<SchedulesOptions>();
  CLI::App* command =
      app.add_subcommand("schedules", "List the schedules that 'improve --schedule' knows");
  command->add_option("NAME", options->name, "Only this one, or a .lua file, with its parameters")
      ->type_name("");
  add_plugin_option(*command, options->plugins);
  command->add_flag("--source", options->source, "Print its script, to start from");
  command->add_flag("--words", options->words, "Explain the words of the language");
  command->add_flag("--markdown", options->markdown, "All of it as in docs/schedules.md");
  command->footer(
      R"(A schedule says which operators are tried where, in which order, and until
when. It is a script in Lua.

Examples:
  tetmend schedules                          the list
  tetmend schedules shell                    the parameters of the default
  tetmend schedules shell --source > my.lua  a start for your own
  tetmend schedules --words                  what a script can say
  tetmend improve part.mesh -o out.mesh --schedule my.lua --set max_rounds=10

Exit status: 0 success, 1 a script has a mistake, 2 wrong usage)");
  command->callback([options, &invocation] {
    invocation.action = [options] { return run_schedules(*options); };
  });
}

}  // namespace tetmend::apps
