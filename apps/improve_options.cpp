// SPDX-License-Identifier: MIT
// The options of `tetmend improve`, from the command line to the library.
#include "apps/improve_options.h"

#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tetmend/option_text.h>

#include "apps/commands.h"
#include "apps/help_formatter.h"
#include "apps/plugins.h"
#include "apps/threads.h"

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

/// What the library says the option takes.
std::string value_of(std::string_view name) {
  for (const OptionForm& form : option_forms()) {
    if (form.name == name) return std::string(form.value);
  }
  return {};
}

/// Adds --NAME, which the library reads.
CLI::Option* add_value(CLI::App& command, Options& options, const std::string& name,
                       const std::string& help) {
  return command
      .add_option_function<std::string>(
          "--" + name, [&options, name](const std::string& value) { set(options, name, value); },
          help)
      ->type_name(value_of(name));
}

/// The same for one that may be given several times.
CLI::Option* add_values(CLI::App& command, Options& options, const std::string& name,
                        const std::string& help) {
  return command
      .add_option_function<std::vector<std::string>>(
          "--" + name,
          [&options, name](const std::vector<std::string>& values) {
            for (const std::string& value : values) set(options, name, value);
          },
          help)
      ->type_name(value_of(name))
      ->allow_extra_args(false);  // so that IN may follow
}

constexpr std::string_view kAdapt = "adapt";

void add_schedule_options(CLI::App& command, ImproveOptions& options) {
  Options& run = options.run;
  add_value(command, run, "schedule",
            "What is tried in which order: one of "
            "'tetmend schedules', or a script "
            "(default: " +
                run.schedule + ")");
  add_values(command, run, "set",
             "Value of a parameter of the schedule, see 'tetmend schedules NAME'; may be "
             "given several times");
  add_value(command, run, "purpose", "The same as --for");
  command
      .add_option_function<std::string>(
          "--for", [&run](const std::string& value) { set(run, "purpose", value); },
          "What the mesh is for: explicit, implicit, volumes or angles (see docs/choosing.md; "
          "default: any solver)")
      ->type_name("NAME");
  add_value(command, run, "goal",
            "Degrees: no dihedral angle under MIN or over MAX (default: 30,150; MAX alone: "
            "180 less MIN). Tets that miss it are bad")
      ->each([&options](const std::string& text) { options.goal = text; });
  add_value(command, run, "measure",
            "What tets are judged by: angles and needles, or with 'sine' angles alone, as "
            "in the paper (default: sine_and_length)");
}

void add_time_limit(CLI::App& command, Options& run) {
  add_value(command, run, "time-limit",
            "Stop improving after that time and write what was reached");
}

void add_plugin_options(CLI::App& command, ImproveOptions& options) {
  add_plugin_option(command, options.run.plugin);
  command
      .add_option("--attempt-limit", options.attempt_limit,
                  "Say so when an attempt of a plugin takes longer; 0: never (default: 10)")
      ->type_name("SECONDS")
      ->check(is_number_of_seconds);
  add_check_option(command, options.run);
}

void add_layers_and_tets(CLI::App& command, Options& options) {
  add_value(command, options, "layers",
            "Boundary layers, prisms cut into tets, stay "
            "as they are (keep, the default) or are "
            "worked on like the rest (improve)");
  CLI::Option* surface = add_value(command, options, "surface",
                                   "How far the surface may move where it holds "
                                   "bad tets: fixed (the default), flat (only "
                                   "where no shape changes), 1% of the lengths "
                                   "of edges there, or a length such as 0.01 "
                                   "(above 5% of the mesh's diagonal: 0.5!)");
  add_value(command, options, "feature-angle",
            "Lines along which faces bend by more stay "
            "where they are (default: 40)")
      ->needs(surface);
  add_value(command, options, "tets",
            "How far the mesh may grow: 10% more tets than there were, or 500000 in all, not "
            "less than there are (default: 15%; with other schedules than shell and polish, "
            "as far as it pays)");
}

void add_protected_regions(CLI::App& command, Options& options) {
  add_values(command, options, "protect", "Leave these tets as they are; repeatable");
  add_values(command, options, "only", "Leave all other tets as they are; repeatable");
}

void add_conserve(CLI::App& command, Options& options) {
  add_values(command, options, "conserve",
             "Keep the integral of this array of the tets: new tets get the mean of the old "
             "by shared volume; may be repeated");
}

void add_region_options(CLI::App& command, Options& options) {
  add_protected_regions(command, options);
  add_layers_and_tets(command, options);
  if (options.schedule != kAdapt) {  // else lengths are those that are wanted
    command.add_flag("--keep-size", options.keep_size,
                     "Make no edge that is shorter than half or longer than twice what edges are "
                     "there in IN");
  }
  command.add_flag("--ignore-interior", options.ignore_interior,
                   "Drop the triangles, edges and required "
                   "vertices that the file names inside a region");
  command.add_flag("--straighten", options.straighten,
                   "Second order: where tets stay turned over, "
                   "make edges of the surface straight");
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

void add_check_option(CLI::App& command, Options& options) {
  command.add_flag("--check-operators", options.check_operators,
                   "Hold each attempt of a plugin to the contract of operators; slow, and in one "
                   "thread");
}

void add_trace_options(CLI::App& command, Options& options) {
  CLI::Option* trace = add_value(command, options, "trace",
                                 "Record all that happens, for 'tetmend trace'; the run uses one "
                                 "thread then");
  add_value(command, options, "trace-around",
            "Record only attempts that aim at a vertex in a ball: around a point, or "
            "around tet N of IN, counted from 0, one less than quality --list says (radius: its "
            "longest edge, if not given)")
      ->needs(trace);
  add_values(command, options, "trace-operator",
             "Record only attempts of this operator, with all that they call; may be "
             "given several times")
      ->needs(trace);
  add_value(command, options, "trace-depth",
            "Record only attempts with at most that many attempts around them; 0: the "
            "outermost")
      ->needs(trace);
  add_value(command, options, "trace-limit",
            "End the trace before it is larger, such as 500M; the run goes on")
      ->needs(trace);
}

void add_options_of_pieces(CLI::App& command, ImproveOptions& options) {
  add_schedule_options(command, options);
  add_plugin_option(command, options.run.plugin);
  add_protected_regions(command, options.run);
  add_layers_and_tets(command, options.run);
  add_carry_options(command, options.carry);
  add_conserve(command, options.run);
  add_threads_option(command, options.run.threads);
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
  add_schedule_options(command, options);
  add_time_limit(command, options.run);
  add_plugin_options(command, options);
  add_threads_option(command, options.run.threads);
  add_piece_options(command, options.pieces);
  add_region_options(command, options.run);
  add_trace_options(command, options.run);
  add_value(
      command, options.run, "trace-piece",
      "In pieces: which one is recorded, in which round (default: in round 1 the piece around "
      "the place of --trace-around, or the one with the worst tet)");
  add_carry_options(command, options.carry);
  add_conserve(command, options.run);
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

void add_folder_option(CLI::App& command) {
  command.add_flag("--no-config")->description("Take no options from tetmend.conf of this folder");
  group_options(command);
}

void add_dry_run_option(CLI::App& command, ImproveOptions& options) {
  command.add_flag(
      "--dry-run", options.dry_run,
      "Write nothing: say what would be kept, what is found, and what the surface forces");
  group_options(command);
}

void add_adapt_options(CLI::App& command, ImproveOptions& options) {
  options.run.schedule = kAdapt;
  Options& run = options.run;
  add_values(command, run, "size",
             "How long edges are to be, see below; may be given several times")
      ->required();
  add_value(command, run, "gradation",
            "Lengths grow by at most this less 1 times the distance; 0: as they like (default: "
            "1.3)");
  add_value(command, run, "smallest", "No length is wanted below that");
  add_value(command, run, "largest", "No length is wanted above that");
  add_improve_options(command, options);
  command.get_option("IN")->description("Mesh to adapt");
  command.get_option("--output")->description("File for the adapted mesh; may be IN");
}

namespace {

/// Files that sizes name, of whatever region.
void list_size_files(const Options& options, std::vector<NamedFile>& files) {
  for (const std::string& text : options.size) {
    const std::filesystem::path file = text.substr(text.find('=') + 1);
    if (file.extension() == ".sol" || file.extension() == ".solb") {
      files.push_back({"--size", file});
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
