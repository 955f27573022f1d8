// SPDX-License-Identifier: MIT
// The command line program: finds out what the user wants, runs it, turns errors into exit
// statuses.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <tetmend/catalogue.h>
#include <tetmend/check.h>
#include <tetmend/io.h>
#include <tetmend/measure.h>
#include <tetmend/rulers.h>

#include "apps/commands.h"
#include "apps/description.h"
#include "apps/files.h"
#include "apps/folder_options.h"
#include "apps/help_formatter.h"
#include "apps/interruption.h"
#include "apps/standard_streams.h"
#include "kernel/nearest_word.h"
#include "kernel/quality.h"
#include "pieces/partitioned_files.h"
#include "platform/platform.h"

namespace tetmend::apps {

namespace {

std::unique_ptr<CLI::App> make_parser(Invocation& invocation) {
  auto app = std::make_unique<CLI::App>(
      "tetmend improves tetrahedral meshes: it removes slivers and raises the worst\n"
      "dihedral angles while the surface stays exactly as it was.",
      "tetmend");
  app->set_version_flag("-V,--version", fmt::format("tetmend {}", version()));
  app->require_subcommand(1);
  app->allow_windows_style_options(false);  // /FOLDER/FILE is no option, there neither
  app->formatter(std::make_shared<HelpFormatter>(asks_for_short_help(invocation.arguments)));
  app->set_help_flag("-h,--help", "What is usual with -h, all with --help");
  app->footer(fmt::format(
      R"(Mesh formats, by extension:
{}
Examples:
  tetmend improve part.mesh -o better.mesh     improve a mesh
  tetmend quality better.mesh                  look at its dihedral angles
  tetmend help improve                         all about one subcommand

Exit status: 0 success, 1 the work failed and OUT is as it was, 2 wrong
usage, 3 written, but a goal that was asked for is missed, 4 written, but
interrupted)",
      mesh_format_list()));
  add_improve(*app, invocation);
  add_adapt(*app, invocation);
  add_quality(*app, invocation);
  add_check(*app, invocation);
  add_convert(*app, invocation);
  add_lesson(*app, invocation);
  add_surface(*app, invocation);
  add_operators(*app, invocation);
  add_schedules(*app, invocation);
  add_trace(*app, invocation);
  add_pieces(*app, invocation);
  add_check_plugin(*app, invocation);
  return app;
}

/// The words that some options take as values, by what they are, for completions.
nlohmann::json words_of_the_library() {
  nlohmann::json words;
  std::set<std::string> settings;
  for (const ScheduleInfo& schedule : schedules()) {
    words["schedule"].push_back(schedule.name);
    for (const ScheduleParameter& parameter : schedule.parameters) settings.insert(parameter.name);
  }
  words["setting"] = settings;
  for (const auto terms : {Standard::Terms::sine_and_length, Standard::Terms::sine}) {
    words["objective"].push_back(to_string(terms));
  }
  for (const OperatorDescription& each : operators()) words["operator"].push_back(each.name);
  for (const CheckPreset& preset : check_presets()) words["preset"].push_back(preset.name);
  for (const RulerInfo& ruler : kRulers) words["ruler"].push_back(ruler.name);
  for (const Measure& measure : measures()) words["measure"].push_back(measure.name);
  for (const FileFormat& format : file_formats()) words["extension"].push_back(format.extension);
  for (const char* file : {"x.msh", "x.vtk", "x.ele", "x.inp"}) {
    for (const std::string_view variant : file_variants(file)) words["variant"].push_back(variant);
  }
  return words;
}

void print_description(const CLI::App& app) {
  nlohmann::json description = describe(app, version());
  description["words"] = words_of_the_library();
  fmt::print("{}\n", description.dump(1));
}

std::vector<std::string> list_subcommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> list_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The parser's own messages come from another check first where a word is unknown, and do not say
/// which subcommands there are.
std::string describe(const CLI::ParseError& error, const CLI::App& app,
                     const Invocation& invocation) {
  const auto chosen = app.get_subcommands();
  for (const std::string& word : app.remaining(true)) {
    if (!word.starts_with("-") && chosen.empty()) break;  // a mistyped subcommand
    if (!word.starts_with("-")) continue;
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    return fmt::format("unknown option '{}'{} (see tetmend{} --help)", word,
                       guess(word.substr(0, word.find('=')), list_options(command)),
                       chosen.empty() ? "" : " " + command.get_name());
  }
  const bool lacks_output = message_of(error).starts_with("--output is missing");
  if (lacks_output && !app.remaining(true).empty()) {
    return fmt::format("{}: did you mean '-o {}'? (see tetmend {} --help)", message_of(error),
                       app.remaining(true).front(), chosen.front()->get_name());
  }
  if (!chosen.empty()) {
    return fmt::format("{} (see tetmend {} --help)", message_of(error), chosen.front()->get_name());
  }
  const std::vector<std::string> names = list_subcommands(app);
  for (const std::string& argument : invocation.arguments) {
    if (argument.starts_with("-")) continue;
    const std::string meant = guess(argument, names);
    return fmt::format("unknown subcommand '{}'{}", argument,
                       meant.empty() ? fmt::format(": expected one of {}", fmt::join(names, ", "))
                                     : fmt::format("{} (see tetmend --help)", meant));
  }
  if (invocation.arguments.empty()) {
    return fmt::format("a subcommand is missing: expected one of {} (see tetmend --help)",
                       fmt::join(names, ", "));
  }
  return fmt::format("{} (see tetmend --help)", message_of(error));
}

/// `tetmend help COMMAND` is `tetmend COMMAND --help`.
void ask_for_help(std::vector<std::string>& arguments, const CLI::App& app) {
  arguments.erase(arguments.begin());
  const std::vector<std::string> names = list_subcommands(app);
  const bool is_known = arguments.size() == 1 &&
                        std::find(names.begin(), names.end(), arguments.front()) != names.end();
  if (!arguments.empty() && !is_known) {
    const std::string word = fmt::format("{}", fmt::join(arguments, " "));
    const std::string all = fmt::format("{}", fmt::join(names, ", "));
    throw UsageError(fmt::format("help: '{}' is no subcommand: expected one of {}{}", word, all,
                                 guess_of(word, all)));
  }
  arguments.emplace_back("--help");
}

using Words = std::vector<std::string>;

/// Parses twice: the command line alone says which command it is, and what of the folder's file it
/// overrides.
void take_folder_options(Invocation& invocation) {
  Words& all = invocation.arguments;
  if (!all.empty() && all.front() == "help") return;
  Invocation alone;
  alone.arguments = all;
  const auto app = make_parser(alone);
  try {
    app->parse(Words(all.rbegin(), all.rend()));
  } catch (const CLI::RequiredError&) {  // the file may have what is missing
  } catch (const CLI::ParseError&) {
    return;  // help, or a mistake that is found again, and told
  }
  invocation.folder_file = folder_file(*app);
  const std::vector<FolderOption> more = folder_options(*app);
  if (more.empty()) return;
  const CLI::App& command = *app->get_subcommands().front();
  // Behind the name of the command: what follows may begin with --.
  const auto place = std::find(all.begin(), all.end(), command.get_name()) - all.begin() + 1;
  Words added;
  for (const FolderOption& option : more) {
    added.push_back(option.argument);
    Words together = alone.arguments;
    together.insert(together.begin() + place, added.begin(), added.end());
    Invocation trial;
    trial.arguments = together;
    const auto parser = make_parser(trial);
    try {
      parser->parse(Words(together.rbegin(), together.rend()));
    } catch (const CLI::RequiredError&) {  // told later, where a later line does not have it
    } catch (const CLI::ParseError& error) {
      throw UsageError(
          fmt::format("{}:{}: {}", kFolderFile, option.line, describe(error, *parser, trial)));
    }
  }
  if (command.get_option("--quiet")->count() == 0) {
    complain(kSuccess, fmt::format("{} says {}", kFolderFile, fmt::join(added, " ")));
  }
  all.insert(all.begin() + place, added.begin(), added.end());
}

int run(int argc, char** argv, Invocation& invocation) {
  invocation.arguments = platform::arguments(argc, argv);
  if (!invocation.arguments.empty()) invocation.arguments.erase(invocation.arguments.begin());
  take_folder_options(invocation);
  const auto app = make_parser(invocation);
  if (!invocation.arguments.empty() && invocation.arguments.front() == "help") {
    ask_for_help(invocation.arguments, *app);
  }
  if (invocation.arguments == std::vector<std::string>{std::string(kDescribe)}) {
    print_description(*app);
    return kSuccess;
  }
  try {
    app->parse(Words(invocation.arguments.rbegin(), invocation.arguments.rend()));  // last first
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app->exit(error);  // prints help or version
    return complain(kWrongUsage, describe(error, *app, invocation));
  }
  return invocation.action();
}

constexpr const char* kNoOutput = "cannot write to standard output";

/// Where files are what was asked for, they alone decide on the status.
int end_of_talk(int status, bool wrote_files) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  if (!wrote_files) return complain(kFailed, kNoOutput);
  complain(kSuccess, "cannot write to standard output: only the report on it is lost");
  return status;
}

int run_and_catch(int argc, char** argv) {
  try {
    Invocation invocation;
    OneRank alone;
    const pieces::PvtuFiles pvtu(alone);
    const pieces::GmshParts gmsh(alone);
    const pieces::SeveralArrayFiles parts({&pvtu, &gmsh});
    invocation.array_files = &parts;
    const int status = run(argc, argv, invocation);
    return end_of_talk(status, invocation.wrote_files);
  } catch (const UsageError& error) {
    return complain(kWrongUsage, error.what());
  } catch (const std::bad_alloc&) {
    return complain(kFailed, "out of memory");
  } catch (const std::exception& error) {
    // A long text fills the buffer, and fails before the end.
    return complain(kFailed, std::ferror(stdout) != 0 ? kNoOutput : error.what());
  } catch (...) {
    return complain(kFailed, "unexpected failure");
  }
}

/// glibc gives large arrays back at once, but raises the size that counts as large, up to 32 MB,
/// with each one that is freed. Of a mesh of a million tets, 16 bytes a tet would never be given
/// back.
void give_back_memory() {
  constexpr int kFrom = 1 << 20;
  platform::give_back_blocks_from(kFrom);
}

}  // namespace
}  // namespace tetmend::apps

int main(int argc, char** argv) {
  tetmend::platform::reserve_standard_streams();
  tetmend::apps::end_without_remains();
  tetmend::apps::give_back_memory();
  return tetmend::apps::run_and_catch(argc, argv);
}
