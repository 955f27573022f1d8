// SPDX-License-Identifier: MIT
// Options as text, as the command line takes them: one row for each.
#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/option_text.h>

#include "kernel/from_chars.h"

namespace tetmend {

namespace {

/// @throws Error, without the name of the option, for a value of another form
using Reader = void (*)(Options&, std::string_view);

struct Row {
  OptionForm form;
  Reader read;
};

/// The whole text as a number from `low` to `high`.
template <class Number>
Number read_in_range(std::string_view text, Number low, Number high, std::string_view what) {
  Number number{};
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (is_number && number >= low && number <= high) return number;
  throw Error(fmt::format("'{}' is not {} from {} to {}", text, what, low, high));
}

bool read_switch(std::string_view text) {
  if (text.empty() || text == "true") return true;
  if (text == "false") return false;
  throw Error(fmt::format("'{}' is neither true nor false", text));
}

std::pair<std::string, std::string> read_setting(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw Error(fmt::format("'{}' is not of the form NAME=VALUE", text));
  }
  return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

/// 35 or 35,140.
Goal read_goal(std::string_view text) {
  const auto read = [&](std::string_view part) {
    double angle = 0;
    const auto [end, error] = from_chars(part.data(), part.data() + part.size(), angle);
    if (error != std::errc() || end != part.data() + part.size()) {
      throw Error(fmt::format("'{}' is not of the form MIN or MIN,MAX", text));
    }
    return angle;
  };
  const std::size_t comma = text.find(',');
  Goal goal = Goal::symmetric(read(text.substr(0, comma)));
  if (comma != std::string_view::npos) goal.max_angle = read(text.substr(comma + 1));
  return goal;
}

Layers read_layers(std::string_view text) {
  if (text == "keep") return Layers::keep;
  if (text == "improve") return Layers::improve;
  throw Error(fmt::format("'{}' is neither keep nor improve", text));
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
  const auto [end, error] = from_chars(digits.data(), digits.data() + digits.size(), count);
  if (error != std::errc() || end != digits.data() + digits.size() || count == 0 ||
      count > std::uint64_t{1} << 50) {
    throw Error(fmt::format("'{}' is not a size such as 500M (K, M or G)", text));
  }
  constexpr std::uint64_t kLeast = 1'000'000;  // no unit is forgotten behind as many
  if (unit == 1 && count < kLeast) {
    throw Error(fmt::format("{0} bytes are less than anything needs: is '{0}M' meant?", text));
  }
  return count * unit;
}

constexpr std::string_view kSwitch = "true|false";
constexpr bool kAdds = true;

// A new option is a row here and a field of Options; the order is that of help.
constexpr Row kRows[] = {
    {{.name = "schedule",
      .value = "NAME|FILE.lua",
      .help = "What is tried in which order: one of 'tetmend schedules', or a script",
      .initial = "shell",
      .group = OptionGroup::usual},
     [](Options& o, std::string_view text) { o.schedule = text; }},
    {{.name = "goal",
      .value = "MIN[,MAX]",
      .help =
          "Degrees: no dihedral angle under MIN or over MAX; MAX alone: 180 less MIN. Tets that "
          "miss it are bad",
      .initial = "30,150",
      .group = OptionGroup::usual},
     [](Options& o, std::string_view text) { o.goal = read_goal(text); }},
    {{.name = "purpose",
      .value = "NAME",
      .help = "What the mesh is for: explicit, implicit, volumes or angles (see docs/choosing.md)",
      .initial = "any solver",
      .group = OptionGroup::usual},
     [](Options& o, std::string_view text) { o.purpose = text; }},
    {{.name = "time-limit",
      .value = "SECONDS",
      .help = "Stop improving after that time and write what was reached",
      .group = OptionGroup::usual},
     [](Options& o, std::string_view text) {
       o.time_limit = read_in_range(text, 1e-3, 1e9, "a number of seconds");
     }},
    {{.name = "threads",
      .value = "N",
      .help = "Worker threads, 1 to 1024; the result is the same for every number",
      .initial = "1",
      .group = OptionGroup::usual,
      .letter = 'j'},
     [](Options& o, std::string_view text) {
       o.threads = read_in_range(text, 1, 1024, "a whole number");
     }},
    {{.name = "surface",
      .value = "fixed|flat|P%|LENGTH",
      .help =
          "How far the surface may move where it holds bad tets: not at all (fixed), only where "
          "no shape changes (flat), 1% of the lengths of edges there, or a length such as "
          "0.01, above 5% of the mesh's diagonal 0.5!",
      .initial = "fixed",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) { o.surface = text; }},
    {{.name = "feature-angle",
      .value = "DEGREES",
      .help = "Lines along which faces bend by more stay where they are",
      .initial = "40",
      .needs = "surface",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) {
       o.feature_angle = read_in_range(text, 0.1, 180.0, "an angle in degrees");
     }},
    {{.name = "tets",
      .value = "P%|N",
      .help =
          "How far the mesh may grow: 10% more tets than there were, or 500000 in all, not less "
          "than there are",
      .initial = "15%; with other schedules than shell and polish, as far as it pays",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) { o.tets = text; }},
    {{.name = "keep-size",
      .value = kSwitch,
      .help = "Make no edge that is shorter than half or longer than twice what edges are there in "
              "IN",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) { o.keep_size = read_switch(text); }},
    {{.name = "gradation",
      .value = "RATIO",
      .help = "Lengths grow by at most this less 1 times the distance; 0: as they like",
      .initial = "1.3",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) {
       o.gradation = read_in_range(text, 0.0, 1e9, "a ratio");
     }},
    {{.name = "smallest",
      .value = "LENGTH",
      .help = "No length is wanted below that",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) {
       o.smallest = read_in_range(text, 0.0, 1e300, "a length");
     }},
    {{.name = "largest",
      .value = "LENGTH",
      .help = "No length is wanted above that",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) {
       o.largest = read_in_range(text, 0.0, 1e300, "a length");
     }},
    {{.name = "layers",
      .value = "keep|improve",
      .help =
          "Boundary layers, prisms cut into tets, stay as they are (keep) or are worked on like "
          "the rest (improve)",
      .initial = "keep",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) { o.layers = read_layers(text); }},
    {{.name = "protect",
      .value = "SPEC",
      .adds = kAdds,
      .help = "Leave these tets as they are; repeatable",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) { o.protect.emplace_back(text); }},
    {{.name = "only",
      .value = "SPEC",
      .adds = kAdds,
      .help = "Leave all other tets as they are; repeatable",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) { o.only.emplace_back(text); }},
    {{.name = "ignore-interior",
      .value = kSwitch,
      .help = "Drop the triangles, edges and required vertices that the file names inside a region",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) { o.ignore_interior = read_switch(text); }},
    {{.name = "straighten",
      .value = kSwitch,
      .help = "Second order: where tets stay turned over, make edges of the surface straight",
      .group = OptionGroup::change},
     [](Options& o, std::string_view text) { o.straighten = read_switch(text); }},
    {{.name = "size",
      .value = "SIZE",
      .adds = kAdds,
      .help = "How long edges are to be, see below; may be given several times",
      .group = OptionGroup::usual},
     [](Options& o, std::string_view text) { o.size.emplace_back(text); }},
    {{.name = "set",
      .value = "NAME=VALUE",
      .adds = kAdds,
      .help = "Value of a parameter of the schedule, see 'tetmend schedules NAME'; may be given "
              "several times",
      .group = OptionGroup::search},
     [](Options& o, std::string_view text) { o.set.push_back(read_setting(text)); }},
    {{.name = "measure",
      .value = "NAME",
      .help = "What tets are judged by: angles and needles, or with 'sine' angles alone, as in the "
              "paper",
      .initial = "sine_and_length",
      .group = OptionGroup::search},
     [](Options& o, std::string_view text) { o.measure = text; }},
    {{.name = "conserve",
      .value = "NAME",
      .adds = kAdds,
      .help = "Keep the integral of this array of the tets: new tets get the mean of the old by "
              "shared volume; may be repeated",
      .group = OptionGroup::data},
     [](Options& o, std::string_view text) { o.conserve.emplace_back(text); }},
    {{.name = "trace",
      .value = "FILE",
      .help = "Record all that happens, for 'tetmend trace'; the run uses one thread then",
      .group = OptionGroup::record},
     [](Options& o, std::string_view text) { o.trace = text; }},
    {{.name = "trace-around",
      .value = "TET[,R]|X,Y,Z,R",
      .help =
          "Record only attempts that aim at a vertex in a ball: around a point, or around tet N "
          "of IN, counted from 0, one less than quality --list says (radius: its longest edge, "
          "if not given)",
      .needs = "trace",
      .group = OptionGroup::record},
     [](Options& o, std::string_view text) { o.trace_around = text; }},
    {{.name = "trace-operator",
      .value = "NAME",
      .adds = kAdds,
      .help =
          "Record only attempts of this operator, with all that they call; may be given several "
          "times",
      .needs = "trace",
      .group = OptionGroup::record},
     [](Options& o, std::string_view text) { o.trace_operator.emplace_back(text); }},
    {{.name = "trace-depth",
      .value = "N",
      .help = "Record only attempts with at most that many attempts around them; 0: the outermost",
      .needs = "trace",
      .group = OptionGroup::record},
     [](Options& o, std::string_view text) {
       o.trace_depth = read_in_range(text, 0, 1000, "a whole number");
     }},
    {{.name = "trace-limit",
      .value = "SIZE",
      .help = "End the trace before it is larger, such as 500M; the run goes on",
      .needs = "trace",
      .group = OptionGroup::record},
     [](Options& o, std::string_view text) { o.trace_limit = read_size(text); }},
    {{.name = "trace-piece",
      .value = "ROUND[:PIECE]",
      .help = "In pieces: which one is recorded, in which round",
      .initial =
          "in round 1 the piece around the place of --trace-around, or the one with the worst "
          "tet",
      .needs = "trace",
      .group = OptionGroup::record},
     [](Options& o, std::string_view text) { o.trace_piece = text; }},
    {{.name = "plugin",
      .value = "FILE",
      .adds = kAdds,
      .help =
          "Load the operators of this shared library; may be repeated. TETMEND_PLUGIN_PATH names "
          "more: files, and folders for all *.so in them",
      .group = OptionGroup::plugins},
     [](Options& o, std::string_view text) {
       if (text.empty()) throw Error("no file is named");
       o.plugin.emplace_back(text);
     }},
    {{.name = "check-operators",
      .value = kSwitch,
      .help = "Hold each attempt of a plugin to the contract of operators; slow, and in one thread",
      .group = OptionGroup::plugins},
     [](Options& o, std::string_view text) { o.check_operators = read_switch(text); }},
    {{.name = "script",
      .value = "TEXT",
      .help = "Text of a schedule, in the place of one that is named"},
     [](Options& o, std::string_view text) { o.script = text; }},
    {{.name = "limit", .value = kSwitch, .help = "Prove what the surface allows at best"},
     [](Options& o, std::string_view text) { o.limit = read_switch(text); }},
};

std::string with(std::string_view text, char old, char made) {
  std::string result(text);
  std::replace(result.begin(), result.end(), old, made);
  return result;
}

}  // namespace

std::vector<OptionForm> option_forms() {
  std::vector<OptionForm> forms;
  for (const Row& row : kRows) forms.push_back(row.form);
  return forms;
}

void set_option(Options& options, std::string_view name, std::string_view value) {
  const auto* const row = std::find_if(std::begin(kRows), std::end(kRows),
                                       [&](const Row& each) { return each.form.name == name; });
  if (row == std::end(kRows)) {
    std::vector<std::string_view> names;
    for (const Row& each : kRows) names.push_back(each.form.name);
    throw OptionError(
        "", fmt::format("there is no option '{}': expected {}", name, fmt::join(names, ", ")));
  }
  try {
    row->read(options, value);
  } catch (const Error& reason) {
    const std::string field = with(name, '-', '_');
    throw OptionError(field, fmt::format("{}: {}", field, reason.what()));
  }
}

std::string message_of(const OptionError& error) {
  const std::string& field = error.option();
  return with(field, '_', '-') + std::string(error.what()).substr(field.size());
}

}  // namespace tetmend
