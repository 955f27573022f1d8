// SPDX-License-Identifier: MIT
// What a script hands to a word, as plain data; and how selections, operators and settings are read
// from it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "schedule/composition.h"
#include "schedule/selection.h"

namespace tetmend {

/// A value without functions in it, as words take and give it.
struct ScriptValue {
  struct Field;
  enum class Kind { nothing, flag, number, text, table };
  Kind kind = Kind::nothing;
  double number = 0;        ///< of a flag: 0 or 1
  bool is_integer = false;  ///< a number that the script wrote without fraction
  std::string text;
  std::vector<ScriptValue> list;  ///< of a table: 1, 2, ... n
  std::vector<Field> fields;      ///< of a table: by name, in their order

  static ScriptValue of_flag(bool flag);
  /// Precondition: a whole number of less than 2^53.
  static ScriptValue of_integer(double number);
  static ScriptValue of_number(double number);
  static ScriptValue of_text(std::string_view text);
  static ScriptValue empty_table();

  /// Null when there is none.
  const ScriptValue* field(std::string_view name) const;
  /// As an error message quotes it: 3, true, "bad", a table.
  std::string quoted() const;
};

/// One named entry of a table.
struct ScriptValue::Field {
  std::string name;
  ScriptValue value;
};

/// How messages name what is being read: "smooth: cycles".
struct Subject {
  std::string text;
  Subject of(std::string_view part) const { return {text + ": " + std::string(part)}; }
};

// Each throws an Error that names the subject, the offending word, and the valid ones.

double read_number(const Subject& subject, const ScriptValue& value);
const std::string& read_text(const Subject& subject, const ScriptValue& value);
/// "bad", "all", or a table of conditions.
Selection read_selection(const Subject& subject, const ScriptValue& value);
/// The name of an operator, {name, parameter = value, ...}, first_of{...}, all_of{...} or
/// sequence{...}.
Composition read_composition(const Registry& registry, const Subject& subject,
                             const ScriptValue& value);
/// Adds a setting of one of the parameters. False if there is no such parameter.
bool read_setting(const Subject& subject, std::span<const ParameterSpec> specs,
                  const std::string& name, const ScriptValue& value, ParameterSettings& settings);

}  // namespace tetmend
