// SPDX-License-Identifier: MIT
#include "schedule/script_value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/nearest_word.h"

namespace tetmend {

namespace {

using ValueKind = ScriptValue::Kind;

[[noreturn]] void refuse(const Subject& subject, std::string_view wanted,
                         const ScriptValue& value) {
  throw Error(fmt::format("{} must be {}, is {}", subject.text, wanted, value.quoted()));
}

[[noreturn]] void refuse_name(const Subject& subject, std::string_view what,
                              const std::string& name, std::span<const std::string_view> valid) {
  const std::string names = fmt::format("{}", fmt::join(valid, ", "));
  throw Error(fmt::format("{} has no {} '{}'; valid: {}{}", subject.text, what, name, names,
                          guess_of(name, names)));
}

double read_in_range(const Subject& subject, const ScriptValue& value, double low, double high) {
  const double number = read_number(subject, value);
  if (!(number >= low && number <= high)) {
    throw Error(fmt::format("{} = {} is outside {} to {}", subject.text, number, low, high));
  }
  return number;
}

std::size_t read_count(const Subject& subject, const ScriptValue& value) {
  constexpr double kMost = 1e12;
  const double number = read_in_range(subject, value, 0, kMost);
  if (number != std::floor(number)) {
    throw Error(fmt::format("{} = {} is not a whole number", subject.text, number));
  }
  return static_cast<std::size_t>(number);
}

Date read_date(const Subject& subject, const ScriptValue& value) {
  const double most = std::numeric_limits<Date>::max();
  return static_cast<Date>(std::min(static_cast<double>(read_count(subject, value)), most));
}

Label read_label(const Subject& subject, const ScriptValue& value) {
  const double number = read_in_range(subject, value, std::numeric_limits<Label>::min(),
                                      std::numeric_limits<Label>::max());
  if (number != std::floor(number)) {
    throw Error(fmt::format("{} = {} is not a whole number", subject.text, number));
  }
  return static_cast<Label>(number);
}

std::vector<Label> read_labels(const Subject& subject, const ScriptValue& value) {
  if (value.kind == ValueKind::number) return {read_label(subject, value)};
  if (value.kind != ValueKind::table || value.list.empty() || !value.fields.empty()) {
    refuse(subject, "a number or a list of numbers", value);
  }
  std::vector<Label> labels;
  for (const ScriptValue& label : value.list) labels.push_back(read_label(subject, label));
  std::sort(labels.begin(), labels.end());
  return labels;
}

Eigen::AlignedBox3d read_box(const Subject& subject, const ScriptValue& value) {
  if (value.kind != ValueKind::table || value.list.size() != 6 || !value.fields.empty()) {
    refuse(subject, "{x_low, y_low, z_low, x_high, y_high, z_high}", value);
  }
  std::array<double, 6> bounds{};
  for (unsigned i = 0; i < 6; ++i) bounds[i] = read_number(subject, value.list[i]);
  const Point low(bounds[0], bounds[1], bounds[2]);
  const Point high(bounds[3], bounds[4], bounds[5]);
  if (!(low.array() <= high.array()).all()) {
    throw Error(fmt::format("{}: the lower corner is not below the upper one", subject.text));
  }
  return {low, high};
}

ValueRange read_range(const Subject& subject, const ScriptValue& value) {
  static constexpr std::array<std::string_view, 2> kFields = {"low", "high"};
  ValueRange range;
  if (value.kind != ValueKind::table || value.list.size() != 1) {
    refuse(subject, "{name, low = number, high = number}", value);
  }
  range.name = read_text(subject, value.list[0]);
  for (const auto& [name, bound] : value.fields) {
    if (name == "low") {
      range.low = read_number(subject.of(name), bound);
    } else if (name == "high") {
      range.high = read_number(subject.of(name), bound);
    } else {
      refuse_name(subject, "field", name, kFields);
    }
  }
  return range;
}

/// A field of a sequence.
void read_field(const Subject& subject, const std::string& name, const ScriptValue& value,
                Composition& composition) {
  static constexpr std::array<std::string_view, 2> kFields = {"desperate", "theta_max"};
  if (name == "desperate") {
    composition.desperate = read_in_range(subject.of(name), value, -1, 2);
  } else if (name == "theta_max") {
    composition.theta_max = read_in_range(subject.of(name), value, 90, 180);
  } else {
    refuse_name(subject.of("sequence"), "field", name, kFields);
  }
}

/// What the words first_of, all_of and sequence make.
Composition read_parts(const Registry& registry, const Subject& subject, const ScriptValue& value,
                       const std::string& how) {
  Composition composition;
  composition.kind = how == "first_of" ? Composition::Kind::first_of
                     : how == "all_of" ? Composition::Kind::all_of
                                       : Composition::Kind::sequence;
  const bool is_sequence = composition.kind == Composition::Kind::sequence;
  for (const ScriptValue& part : value.list) {
    composition.parts.push_back(read_composition(registry, subject, part));
  }
  if (composition.parts.empty()) throw Error(fmt::format("{}: nothing to try", subject.text));
  if (is_sequence &&
      (composition.parts.size() < 2 || composition.parts[0].kind != Composition::Kind::one)) {
    throw Error(fmt::format("{}: a sequence is an operator and what follows it", subject.text));
  }
  for (const auto& [name, setting] : value.fields) {
    if (name == "how") continue;
    if (!is_sequence) throw Error(fmt::format("{}: {} has no field '{}'", subject.text, how, name));
    read_field(subject, name, setting, composition);
  }
  return composition;
}

EdgeOrder read_order(const Subject& subject, const ScriptValue& value) {
  static constexpr std::array<std::string_view, 4> kOrders = {"sine", "angle", "longest",
                                                              "shortest"};
  const std::string& name = read_text(subject, value);
  if (name == "sine") return EdgeOrder::sine;
  if (name == "angle") return EdgeOrder::angle;
  if (name == "longest") return EdgeOrder::longest;
  if (name == "shortest") return EdgeOrder::shortest;
  refuse_name(subject, "value", name, kOrders);
}

unsigned read_most_edges(const Subject& subject, const ScriptValue& value) {
  read_in_range(subject, value, 1, 6);
  return static_cast<unsigned>(read_count(subject, value));
}

}  // namespace

ScriptValue ScriptValue::of_flag(bool flag) {
  ScriptValue value;
  value.kind = ValueKind::flag;
  value.number = flag ? 1 : 0;
  return value;
}

ScriptValue ScriptValue::of_integer(double number) {
  ScriptValue value = of_number(number);
  value.is_integer = true;
  return value;
}

ScriptValue ScriptValue::of_number(double number) {
  ScriptValue value;
  value.kind = ValueKind::number;
  value.number = number;
  return value;
}

ScriptValue ScriptValue::of_text(std::string_view text) {
  ScriptValue value;
  value.kind = ValueKind::text;
  value.text = text;
  return value;
}

ScriptValue ScriptValue::empty_table() {
  ScriptValue value;
  value.kind = ValueKind::table;
  return value;
}

const ScriptValue* ScriptValue::field(std::string_view name) const {
  for (const auto& [key, value] : fields) {
    if (key == name) return &value;
  }
  return nullptr;
}

std::string ScriptValue::quoted() const {
  switch (kind) {
    case ValueKind::nothing:
      return "nothing";
    case ValueKind::flag:
      return number != 0 ? "true" : "false";
    case ValueKind::number:
      return fmt::format("{}", number);
    case ValueKind::text:
      return "'" + text + "'";
    case ValueKind::table:
      return "a table";
  }
  return "";
}

double read_number(const Subject& subject, const ScriptValue& value) {
  if (value.kind != ValueKind::number || !std::isfinite(value.number)) {
    refuse(subject, "a number", value);
  }
  return value.number;
}

const std::string& read_text(const Subject& subject, const ScriptValue& value) {
  if (value.kind != ValueKind::text) refuse(subject, "a text", value);
  return value.text;
}

Selection read_selection(const Subject& subject, const ScriptValue& value) {
  static constexpr std::array<std::string_view, 8> kFields = {
      "at_least", "below", "box", "label", "property", "share", "since", "worst"};
  Selection selection;
  if (value.kind == ValueKind::text && value.text == "bad") return selection;
  if (value.kind == ValueKind::text && value.text == "all") {
    selection.below = Selection::kAll;
    return selection;
  }
  if (value.kind != ValueKind::table || !value.list.empty()) {
    refuse(subject, "'bad', 'all' or a table of conditions", value);
  }
  for (const auto& [name, condition] : value.fields) {
    const Subject field = subject.of(name);
    if (name == "below") {
      selection.below = static_cast<Quality>(read_in_range(field, condition, -100, 100));
    } else if (name == "at_least") {
      selection.at_least = read_count(field, condition);
    } else if (name == "worst") {
      selection.worst = read_count(field, condition);
    } else if (name == "share") {
      selection.share = read_in_range(field, condition, 0, 1);
    } else if (name == "label") {
      selection.labels = read_labels(field, condition);
    } else if (name == "box") {
      selection.box = read_box(field, condition);
    } else if (name == "since") {
      selection.since = read_date(field, condition);
    } else if (name == "property") {
      selection.value = read_range(field, condition);
    } else {
      refuse_name(subject, "condition", name, kFields);
    }
  }
  return selection;
}

Composition read_composition(const Registry& registry, const Subject& subject,
                             const ScriptValue& value) {
  Composition composition;
  if (value.kind == ValueKind::text) {
    composition.operator_name = registry.find(value.text).name;
    return composition;
  }
  if (value.kind != ValueKind::table) {
    refuse(subject, "an operator, first_of{...}, all_of{...} or sequence{...}", value);
  }
  if (const ScriptValue* how = value.field("how")) {
    const std::string& word = read_text(subject, *how);
    if (word == "first_of" || word == "all_of" || word == "sequence") {
      return read_parts(registry, subject, value, word);
    }
  }
  if (value.list.size() != 1) {
    throw Error(fmt::format("{}: an operator with settings is {{name, parameter = value, ...}}",
                            subject.text));
  }
  const OperatorInfo& info = registry.find(read_text(subject, value.list[0]));
  composition.operator_name = info.name;
  for (const auto& [name, setting] : value.fields) {
    const Subject field = {std::string(info.name) + ": " + name};
    if (name == "order") {
      composition.order = read_order(field, setting);
    } else if (name == "most_edges") {
      composition.most_edges = read_most_edges(field, setting);
    } else if (!read_setting(field, info.parameters, name, setting, composition.settings)) {
      std::vector<std::string_view> valid = {"order", "most_edges"};
      for (const ParameterSpec& spec : info.parameters) valid.push_back(spec.name);
      refuse_name({std::string(info.name)}, "parameter", name, valid);
    }
  }
  return composition;
}

bool read_setting(const Subject& subject, std::span<const ParameterSpec> specs,
                  const std::string& name, const ScriptValue& value, ParameterSettings& settings) {
  const auto spec = std::find_if(specs.begin(), specs.end(),
                                 [&](const ParameterSpec& s) { return s.name == name; });
  if (spec == specs.end()) return false;
  const bool is_flag = spec->kind == ParameterSpec::Kind::flag;
  if (is_flag && value.kind != ValueKind::flag) refuse(subject, "true or false", value);
  if (!is_flag) read_number(subject, value);
  settings.emplace_back(name, value.number);
  return true;
}

}  // namespace tetmend
