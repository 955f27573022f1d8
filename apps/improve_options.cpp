// SPDX-License-Identifier: MIT
// The options of `tetmend improve`, from the command line to the library.
#include "apps/improve_options.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/plugins.h"
#include "apps/threads.h"

namespace tetmend::apps {
namespace {

void add_schedule_options(CLI::App& command, ImproveOptions& options) {
  command
      .add_option("--schedule", options.run.schedule,
                  "What is tried in which order: one of\n"
                  "'tetmend schedules', or a script\n"
                  "(default: shell)")
      ->type_name("NAME|FILE.lua");
  command
      .add_option("--set", options.settings,
                  "Value of a parameter of the schedule,\nsee 'tetmend schedules NAME'; may be\n"
                  "given several times")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--goal", options.goal,
                  "Degrees: no dihedral angle under MIN or\nover MAX (default: 30,150; MAX alone: "
                  "180\nless MIN). Tets that miss it are bad")
      ->type_name("MIN[,MAX]");
  command
      .add_option("--measure", options.run.measure,
                  "What tets are judged by: angles and needles,\nor with 'sine' angles alone, as "
                  "in the\npaper (default: sine_and_length)")
      ->type_name("NAME");
  command
      .add_option("--time-limit", options.run.time_limit,
                  "Stop improving after that time and\nwrite what was reached")
      ->type_name("SECONDS")
      ->check(CLI::Range(1e-3, 1e9).description(""));
}

void add_plugin_options(CLI::App& command, ImproveOptions& options) {
  add_plugin_option(command, options.run.plugin);
  command
      .add_option("--attempt-limit", options.attempt_limit,
                  "Say so when an attempt of a plugin takes\nlonger; 0: never (default: 10)")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.0, 1e9).description(""));
  command.add_flag("--check-operators", options.run.check_operators,
                   "Hold each attempt of a plugin to the contract\nof operators; slow, and in one "
                   "thread");
}

void add_region_options(CLI::App& command, Options& options) {
  // One SPEC for each mention of the option, so that IN may follow.
  command.add_option("--protect", options.protect, "Leave these tets as they are; repeatable")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  command.add_option("--only", options.only, "Leave all other tets as they are; repeatable")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--layers",
          [&options](const std::string& choice) {
            options.layers = choice == "improve" ? Layers::improve : Layers::keep;
          },
          "Boundary layers, prisms cut into tets, stay\n"
          "as they are (keep, the default) or are\n"
          "worked on like the rest (improve)")
      ->type_name("keep|improve")
      ->check(CLI::IsMember({"keep", "improve"}).description(""));
  command
      .add_option("--tets", options.tets,
                  "How far the mesh may grow: 10% more tets\nthan there were, or 500000 in all "
                  "(default:\nas far as it pays)")
      ->type_name("P%|N");
  command.add_flag("--keep-size", options.keep_size,
                   "Make no edge that is shorter than half or\nlonger than twice what edges are "
                   "there in IN");
  command.add_flag("--ignore-interior", options.ignore_interior,
                   "Drop the triangles, edges and required\n"
                   "vertices that the file names inside a region");
}

void add_trace_options(CLI::App& command, ImproveOptions& options) {
  CLI::Option* trace =
      command
          .add_option("--trace", options.run.trace,
                      "Record all that happens, for 'tetmend\ntrace'; the run uses one thread then")
          ->type_name("FILE");
  command
      .add_option("--trace-around", options.run.trace_around,
                  "Record only attempts that aim at a vertex\nin a ball: around a point, or "
                  "around tet N\nof IN, counted from 0 (radius: its\nlongest edge, if not given)")
      ->type_name("TET[,R]|X,Y,Z,R")
      ->needs(trace);
  command
      .add_option("--trace-operator", options.run.trace_operator,
                  "Record only attempts of this operator, with\nall that they call; may be "
                  "given several\ntimes")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->needs(trace);
  command
      .add_option("--trace-depth", options.run.trace_depth,
                  "Record only attempts with at most that many\nattempts around them; 0: the "
                  "outermost")
      ->type_name("N")
      ->check(CLI::Range(0, 1000).description(""))
      ->needs(trace);
  command
      .add_option("--trace-limit", options.trace_limit,
                  "End the trace before it is larger, such as\n500M; the run goes on")
      ->type_name("SIZE")
      ->needs(trace);
}

std::vector<std::pair<std::string, std::string>> split_settings(
    const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw UsageError(fmt::format("--set: '{}' is not of the form NAME=VALUE", text));
    }
    settings.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return settings;
}

/// 35 or 35,140.
Goal read_goal(const std::string& text) {
  Goal goal;
  const std::size_t comma = text.find(',');
  const auto read = [&](std::string_view part) {
    double angle = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), angle);
    if (error != std::errc() || end != part.data() + part.size()) {
      throw UsageError(fmt::format("--goal: '{}' is not of the form MIN or MIN,MAX", text));
    }
    return angle;
  };
  const std::string_view whole = text;
  goal = Goal::symmetric(read(whole.substr(0, comma)));
  if (comma != std::string::npos) goal.max_angle = read(whole.substr(comma + 1));
  return goal;
}

/// 5000, 500K, 500M, 5G.
std::uint64_t read_size(std::string_view text) {
  constexpr std::string_view kUnits = "KMG";
  std::uint64_t unit = 1;
  std::string_view digits = text;
  if (const std::size_t i = text.empty() ? kUnits.npos : kUnits.find(text.back());
      i != kUnits.npos) {
    digits.remove_suffix(1);
    for (std::size_t k = 0; k <= i; ++k) unit *= 1000;
  }
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (error != std::errc() || end != digits.data() + digits.size() || count == 0 ||
      count > std::uint64_t{1} << 50) {
    throw UsageError(
        fmt::format("--trace-limit: '{}' is not a size such as 500M (K, M or G)", text));
  }
  return count * unit;
}

}  // namespace

void add_improve_options(CLI::App& command, ImproveOptions& options) {
  command.add_option("IN", options.input, "Mesh to improve")->required()->type_name("");
  command.add_option("-o,--output", options.output, "File for the improved mesh; may be IN")
      ->required()
      ->type_name("OUT");
  add_schedule_options(command, options);
  add_plugin_options(command, options);
  add_threads_option(command, options.run.threads);
  add_region_options(command, options.run);
  add_trace_options(command, options);
  add_carry_options(command, options.carry);
  command
      .add_option("--conserve", options.run.conserve,
                  "Keep the integral of this array of the\ntets: new tets get the mean of the old "
                  "by\nshared volume; may be repeated")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  add_format_option(command, options.format);
  command.add_option("--report", options.report, "Write all that is printed, and more, as JSON")
      ->type_name("FILE.json");
  command.add_flag("-q,--quiet", options.quiet, "Print nothing but errors");
}

std::string region_help() {
  return R"(A SPEC is one of
  label:1,4                the tets with label 1 or 4
  box:x0,y0,z0,x1,y1,z1    the tets with all four vertices in the box, its
                           surface included; inf and -inf are allowed
--protect prevails over --only. Protected tets keep their vertices, bit by bit.
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
  run.set = split_settings(options.settings);
  if (!options.goal.empty()) run.goal = read_goal(options.goal);
  if (!options.trace_limit.empty()) run.trace_limit = read_size(options.trace_limit);
  run.limit = true;
  run.maps = false;
  run.rulers = !options.quiet || !options.report.empty();
  try {
    tetmend::check(run);
  } catch (const OptionError& error) {
    throw UsageError(message_of(error));
  }
}

std::string message_of(const OptionError& error) {
  std::string flag = error.option();
  std::replace(flag.begin(), flag.end(), '_', '-');
  return fmt::format("--{}{}", flag, std::string_view(error.what()).substr(flag.size()));
}

}  // namespace tetmend::apps
