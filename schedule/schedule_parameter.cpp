// SPDX-License-Identifier: MIT
#include "schedule/schedule_parameter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/printable.h"

namespace tetmend {

namespace {

using ParameterKind = ScheduleParameter::Kind;

constexpr double kExactIntegers = 9007199254740992;  // 2^53

std::vector<std::string> read_choices(const Subject& subject, const ScriptValue& value) {
  std::vector<std::string> choices;
  for (const ScriptValue& choice : value.list) {
    choices.push_back(read_text(subject, choice));
    if (printable(choices.back()) == choices.back()) continue;
    throw Error(fmt::format("{}: '{}' has control characters", subject.text, choices.back()));
  }
  if (choices.empty()) throw Error(fmt::format("{} must be a list of texts", subject.text));
  return choices;
}

void read_default(const Subject& subject, const ScriptValue& value, ScheduleParameter& parameter) {
  parameter.initial = value.number;
  if (value.kind == ScriptValue::Kind::flag) {
    parameter.kind = ParameterKind::flag;
    return;
  }
  read_number(subject, value);
  parameter.kind = value.is_integer ? ParameterKind::integer : ParameterKind::real;
}

void check_name(const std::string& name, const std::vector<ScheduleParameter>& earlier) {
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_word)) {
    throw Error(fmt::format("parameter: '{}' is no name: letters, digits and _", name));
  }
  for (const ScheduleParameter& other : earlier) {
    if (other.name == name) throw Error(fmt::format("parameter: '{}' exists already", name));
  }
}

/// @throws Error unless all of the text is a number.
double parse_number(const ScheduleParameter& parameter, const std::string& text) {
  double number = 0;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) {
    throw Error(fmt::format("{} must be a number from {}, is '{}'", parameter.name,
                            parameter.range(), text));
  }
  return number;
}

double checked_number(const ScheduleParameter& parameter, const std::string& text) {
  const double number = parse_number(parameter, text);
  if (!(number >= parameter.low && number <= parameter.high)) {
    throw Error(fmt::format("{} = {} is outside {}", parameter.name, text, parameter.range()));
  }
  if (parameter.kind == ParameterKind::integer && number != std::floor(number)) {
    throw Error(fmt::format("{} = {} is not a whole number", parameter.name, text));
  }
  return number;
}

}  // namespace

std::string ScheduleParameter::range() const {
  switch (kind) {
    case ParameterKind::flag:
      return "true or false";
    case ParameterKind::choice:
      return fmt::format("{}", fmt::join(choices, ", "));
    case ParameterKind::integer:
    case ParameterKind::real:
      break;
  }
  return fmt::format("{} to {}", low, high);
}

std::string ScheduleParameter::initial_text() const {
  if (kind == ParameterKind::flag) return initial != 0 ? "true" : "false";
  return kind == ParameterKind::choice ? choices.front() : fmt::format("{}", initial);
}

ScheduleParameter read_parameter(const ScriptValue& value,
                                 const std::vector<ScheduleParameter>& earlier) {
  if (value.list.size() != 1) {
    throw Error("parameter: the name comes first: parameter{\"name\", default = 1, ...}");
  }
  ScheduleParameter parameter;
  parameter.name = read_text({"parameter: name"}, value.list[0]);
  check_name(parameter.name, earlier);
  parameter.low = -kExactIntegers;
  parameter.high = kExactIntegers;
  const Subject subject{"parameter " + parameter.name};
  bool has_default = false;
  for (const auto& [name, field] : value.fields) {
    if (name == "default") {
      read_default(subject.of(name), field, parameter);
      has_default = true;
    } else if (name == "low") {
      parameter.low = read_number(subject.of(name), field);
    } else if (name == "high") {
      parameter.high = read_number(subject.of(name), field);
    } else if (name == "help") {
      parameter.help = printable(read_text(subject.of(name), field));
    } else if (name == "choices") {
      parameter.choices = read_choices(subject.of(name), field);
    } else {
      throw Error(fmt::format("{} has no field '{}'; valid: choices, default, help, high, low",
                              subject.text, name));
    }
  }
  if (!parameter.choices.empty()) parameter.kind = ParameterKind::choice;
  if (has_default != parameter.choices.empty()) {
    throw Error(fmt::format("{} needs either a default or choices", subject.text));
  }
  const bool is_number =
      parameter.kind == ParameterKind::integer || parameter.kind == ParameterKind::real;
  if (is_number && !(parameter.initial >= parameter.low && parameter.initial <= parameter.high)) {
    throw Error(fmt::format("{}: the default {} is outside {}", subject.text, parameter.initial,
                            parameter.range()));
  }
  return parameter;
}

std::pair<double, std::string> chosen_value(const ScheduleParameter& parameter,
                                            const ScheduleSettings& settings) {
  const auto setting = std::find_if(settings.rbegin(), settings.rend(), [&](const auto& entry) {
    return entry.first == parameter.name;
  });
  if (setting == settings.rend()) {
    return {parameter.initial,
            parameter.kind == ParameterKind::choice ? parameter.choices.front() : ""};
  }
  const std::string& text = setting->second;
  switch (parameter.kind) {
    case ParameterKind::choice:
      if (std::find(parameter.choices.begin(), parameter.choices.end(), text) !=
          parameter.choices.end())
        return {0, text};
      break;
    case ParameterKind::flag:
      if (text == "true" || text == "false") return {text == "true" ? 1 : 0, ""};
      break;
    case ParameterKind::integer:
    case ParameterKind::real:
      return {checked_number(parameter, text), ""};
  }
  throw Error(fmt::format("{} = {}: valid: {}", parameter.name, text, parameter.range()));
}

}  // namespace tetmend
