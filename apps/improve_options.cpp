// SPDX-License-Identifier: MIT
// The options of `tetmend improve`, from the command line to the library.
#include "apps/improve_options.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tetmend/option_text.h>

#include "apps/commands.h"
#include "apps/help_formatter.h"
#include "apps/option_help.h"
#include "apps/plugins.h"

namespace tetmend::apps {
namespace {

/// An option of the library; the parser adds to the message where help is.
void set(Options& options, const std::string& name, const std::string& value) {
  try {
    set_option(options, name, value);
  } catch (const OptionError& error) {
    throw CLI::ValidationError("--" + message_of(error));
  }
}

/// Adds an option of the library, as its row says.
CLI::Option& add_form(CLI::App& command, Options& options, const OptionForm& form) {
  const std::string name(form.name);
  const auto set_one = [&options, name](const std::string& value) { set(options, name, value); };
  const std::string letter = form.letter == '\0' ? "" : fmt::format("-{},", form.letter);
  const std::string names = letter + "--" + name;
  CLI::Option* added = nullptr;
  if (form.is_switch()) {
    added = command.add_flag_function(
        names, [set_one](std::int64_t times) { set_one(times > 0 ? "true" : "false"); });
  } else if (form.adds) {
    added = command.add_option_function<std::vector<std::string>>(
        names, [set_one](const std::vector<std::string>& values) {
          std::for_each(values.begin(), values.end(), set_one);
        });
    added->allow_extra_args(false);  // so that IN may follow
  } else {
    added = command.add_option_function<std::string>(names, set_one);
  }
  if (!form.is_switch()) added->type_name(std::string(form.value));
  return *added->description(help_of(form))->group(heading_of(form.group));
}

/// An option that does nothing without another asks for it.
void add_needs(CLI::App& command) {
  for (const OptionForm& form : option_forms()) {
    CLI::Option* const option = command.get_option_no_throw("--" + std::string(form.name));
    if (option == nullptr || form.needs.empty()) continue;
    option->needs(command.get_option("--" + std::string(form.needs)));
  }
}

constexpr std::string_view kAdapt = "adapt";

bool is_of_no_command(std::string_view name) {
  return name == "script" || name == "limit";
}

bool is_of_adapt(std::string_view name) {
  return name == "size" || name == "gradation" || name == "smallest" || name == "largest";
}

/// Tasks last as long as they last, and have no whole mesh.
bool is_of_whole_meshes(std::string_view name) {
  return name == "time-limit" || name == "keep-size" || name == "ignore-interior" ||
         name == "straighten" || name == "trace-piece";
}

/// It has a second name, the usual one.
void add_purpose(CLI::App& command, Options& run, const OptionForm& form) {
  add_form(command, run, form)
      .description("The same as --for")
      ->group(heading_of(OptionGroup::search));
  const auto set_purpose = [&run](const std::string& value) { set(run, "purpose", value); };
  command.add_option_function<std::string>("--for", set_purpose)
      ->type_name(std::string(form.value))
      ->description(help_of(form))
      ->group(heading_of(form.group));
}

/// @param has whether the command has the option of this name
void add_forms(CLI::App& command, ImproveOptions& options,
               const std::function<bool(std::string_view)>& has) {
  Options& run = options.run;
  for (OptionForm form : option_forms()) {
    if (is_of_no_command(form.name) || !has(form.name)) continue;
    if (form.name == "schedule") form.initial = run.schedule;
    if (form.name == "purpose") {
      add_purpose(command, run, form);
    } else if (form.name == "plugin") {
      add_plugin_option(command, run.plugin);
    } else {
      add_form(command, run, form);
    }
  }
  command.get_option("--goal")->each([&options](const std::string& text) { options.goal = text; });
  add_needs(command);
}

void add_talk_options(CLI::App& command, ImproveOptions& options) {
  CLI::Option* const quiet =
      command.add_flag("-q,--quiet", options.quiet, "Print nothing but errors");
  command
      .add_flag(
          "-v,--verbose", options.verbose,
          "Print all figures, what holds the bad tets that are left, and the time of each pass")
      ->excludes(quiet);
}

}  // namespace

void add_options_of_pieces(CLI::App& command, ImproveOptions& options) {
  add_forms(command, options,
            [](std::string_view name) { return !is_of_adapt(name) && !is_of_whole_meshes(name); });
  add_carry_options(command, options.carry);
  command
      .add_option("--report", options.reports,
                  "join: write all that is printed at the end, and more, as .json; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_talk_options(command, options);
}

std::string is_number_of_seconds(const std::string& text) {
  double seconds = 0;
  const bool is_good = CLI::detail::lexical_cast(text, seconds) && seconds >= 0 && seconds <= 1e9;
  if (is_good) return {};
  return fmt::format("'{}' is not a number of seconds from 0 to 1000000000", text);
}

void add_improve_options(CLI::App& command, ImproveOptions& options) {
  command.add_option("IN", options.input, "Mesh to improve")->required()->type_name("");
  command.add_option("-o,--output", options.output, "File for the improved mesh; may be IN")
      ->required()
      ->type_name("OUT");
  const bool adapts = options.run.schedule == kAdapt;
  add_forms(command, options, [adapts](std::string_view name) {
    return adapts ? name != "keep-size" : !is_of_adapt(name);  // lengths are those wanted
  });
  command
      .add_option("--attempt-limit", options.attempt_limit,
                  "Say so when an attempt of a plugin takes longer; 0: never (default: 10)")
      ->type_name("SECONDS")
      ->check(is_number_of_seconds);
  add_piece_options(command, options.pieces);
  add_carry_options(command, options.carry);
  add_format_option(command, options.format);
  command
      .add_option(
          "--report", options.reports,
          "Write all that is printed, and more: .json for programs, .html with pictures, for a "
          "browser; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);  // so that IN may follow
  add_talk_options(command, options);
  group_options(command);
}

void add_goal_option(CLI::App& command, Options& options) {
  for (const OptionForm& form : option_forms()) {
    if (form.name == "goal") add_form(command, options, form);
  }
  group_options(command);
}

void add_folder_option(CLI::App& command) {
  command.add_flag("--no-config")->description("Take no options from tetmend.conf of this folder");
  group_options(command);
}

void add_dry_run_option(CLI::App& command, ImproveOptions& options) {
  command
      .add_flag("--dry-run", options.dry_run,
                "Write nothing, so OUT may be left out: say what would be kept, what is found, and "
                "what the surface forces")
      ->each([&command](const std::string&) { command.get_option("--output")->required(false); });
  group_options(command);
}

void add_adapt_options(CLI::App& command, ImproveOptions& options) {
  options.run.schedule = kAdapt;
  add_improve_options(command, options);
  command.get_option("--size")->required();
  command.get_option("IN")->description("Mesh to adapt");
  command.get_option("--output")->description("File for the adapted mesh; may be IN");
}

namespace {

/// Files that sizes name, of whatever region.
void list_size_files(const Options& options, std::vector<NamedFile>& files) {
  for (const std::string& text : options.size) {
    const std::string size = text.substr(text.find('=') + 1);
    const std::filesystem::path file = size;
    const std::string extension = file.extension().string();
    if (extension == ".sol" || extension == ".solb" || extension == ".lua") {
      files.push_back({"--size", file});
    } else if (const auto colon = size.rfind(':'); colon != std::string::npos) {
      const std::filesystem::path background = size.substr(0, colon);
      if (background.has_extension())
        files.push_back({"--size", background, NamedFile::Kind::mesh});
    }
  }
}

}  // namespace

std::vector<NamedFile> files_of_options(const Options& options) {
  std::vector<NamedFile> files;
  const std::filesystem::path schedule = options.schedule;
  if (schedule.extension() == ".lua") files.push_back({"--schedule", schedule});
  list_size_files(options, files);
  for (const std::filesystem::path& plugin : all_plugins(options.plugin)) {
    files.push_back({"--plugin", plugin});
  }
  return files;
}

std::string region_help() {
  return R"(A SPEC is one of
  label:1,4                the tets with label 1 or 4
  box:x0,y0,z0,x1,y1,z1    the tets with all four vertices in the box, its
                           surface included; inf and -inf are allowed
--protect prevails over --only. Protected tets keep their vertices, bit for bit.
So do boundary layers: stacks of prisms on walls, each cut into three tets. They
are found by their structure, and --layers improve gives them up.

What the file names inside a region - triangles with tets of the same label on
both sides, edges and required vertices - is respected, unless
--ignore-interior drops it; what was dropped is not written to OUT. The surface
and the faces between different labels are respected always.)";
}

void complete(ImproveOptions& options) {
  Options& run = options.run;
  run.plugin = all_plugins(run.plugin);
  run.limit = true;
  run.maps = false;
  run.rulers = !options.quiet || !options.reports.empty();
  try {
    tetmend::check(run);
  } catch (const OptionError& error) {
    throw UsageError("--" + message_of(error));
  }
}

}  // namespace tetmend::apps
