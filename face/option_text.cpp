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
Number read_number(std::string_view text, Number low, Number high, std::string_view what) {
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
  return count * unit;
}

constexpr std::string_view kSwitch = "true|false";
constexpr bool kAdds = true;

constexpr Row kRows[] = {
    {{"schedule", "NAME|FILE.lua"}, [](Options& o, std::string_view text) { o.schedule = text; }},
    {{"script", "TEXT"}, [](Options& o, std::string_view text) { o.script = text; }},
    {{"set", "NAME=VALUE", kAdds},
     [](Options& o, std::string_view text) { o.set.push_back(read_setting(text)); }},
    {{"purpose", "NAME"}, [](Options& o, std::string_view text) { o.purpose = text; }},
    {{"goal", "MIN[,MAX]"}, [](Options& o, std::string_view text) { o.goal = read_goal(text); }},
    {{"measure", "NAME"}, [](Options& o, std::string_view text) { o.measure = text; }},
    {{"time-limit", "SECONDS"},
     [](Options& o, std::string_view text) {
       o.time_limit = read_number(text, 1e-3, 1e9, "a number of seconds");
     }},
    {{"plugin", "FILE", kAdds},
     [](Options& o, std::string_view text) {
       if (text.empty()) throw Error("no file is named");
       o.plugin.emplace_back(text);
     }},
    {{"check-operators", kSwitch},
     [](Options& o, std::string_view text) { o.check_operators = read_switch(text); }},
    {{"threads", "N"},
     [](Options& o, std::string_view text) {
       o.threads = read_number(text, 1, 1024, "a whole number");
     }},
    {{"protect", "SPEC", kAdds},
     [](Options& o, std::string_view text) { o.protect.emplace_back(text); }},
    {{"only", "SPEC", kAdds}, [](Options& o, std::string_view text) { o.only.emplace_back(text); }},
    {{"layers", "keep|improve"},
     [](Options& o, std::string_view text) { o.layers = read_layers(text); }},
    {{"surface", "fixed|flat|P%|LENGTH"},
     [](Options& o, std::string_view text) { o.surface = text; }},
    {{"feature-angle", "DEGREES"},
     [](Options& o, std::string_view text) {
       o.feature_angle = read_number(text, 0.1, 180.0, "an angle in degrees");
     }},
    {{"tets", "P%|N"}, [](Options& o, std::string_view text) { o.tets = text; }},
    {{"keep-size", kSwitch},
     [](Options& o, std::string_view text) { o.keep_size = read_switch(text); }},
    {{"size", "SIZE", kAdds}, [](Options& o, std::string_view text) { o.size.emplace_back(text); }},
    {{"gradation", "RATIO"},
     [](Options& o, std::string_view text) {
       o.gradation = read_number(text, 0.0, 1e9, "a ratio");
     }},
    {{"smallest", "LENGTH"},
     [](Options& o, std::string_view text) {
       o.smallest = read_number(text, 0.0, 1e300, "a length");
     }},
    {{"largest", "LENGTH"},
     [](Options& o, std::string_view text) {
       o.largest = read_number(text, 0.0, 1e300, "a length");
     }},
    {{"ignore-interior", kSwitch},
     [](Options& o, std::string_view text) { o.ignore_interior = read_switch(text); }},
    {{"conserve", "NAME", kAdds},
     [](Options& o, std::string_view text) { o.conserve.emplace_back(text); }},
    {{"trace", "FILE"}, [](Options& o, std::string_view text) { o.trace = text; }},
    {{"trace-piece", "ROUND[:PIECE]"},
     [](Options& o, std::string_view text) { o.trace_piece = text; }},
    {{"trace-around", "TET[,R]|X,Y,Z,R"},
     [](Options& o, std::string_view text) { o.trace_around = text; }},
    {{"trace-operator", "NAME", kAdds},
     [](Options& o, std::string_view text) { o.trace_operator.emplace_back(text); }},
    {{"trace-depth", "N"},
     [](Options& o, std::string_view text) {
       o.trace_depth = read_number(text, 0, 1000, "a whole number");
     }},
    {{"trace-limit", "SIZE"},
     [](Options& o, std::string_view text) { o.trace_limit = read_size(text); }},
    {{"limit", kSwitch}, [](Options& o, std::string_view text) { o.limit = read_switch(text); }},
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
