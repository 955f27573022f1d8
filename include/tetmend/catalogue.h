// SPDX-License-Identifier: MIT
// What there is to improve a mesh with: schedules and operators, with their parameters.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/error.h>

namespace tetmend {

/// A parameter that a schedule declares; Options::set gives it a value.
struct TETMEND_API ScheduleParameter {
  /// What values it takes; a choice is one of several words.
  enum class Kind : std::uint8_t { integer, real, flag, choice };
  std::string name;                  ///< as Options::set names it
  Kind kind = Kind::real;            ///< what values it takes
  double low = 0;                    ///< of numbers
  double high = 0;                   ///< of numbers
  double initial = 0;                ///< of numbers and flags
  std::vector<std::string> choices;  ///< of a choice; the first is the default
  std::string help;                  ///< what it is for, one line

  /// "0 to 10", "true or false", "a, b or c".
  std::string range() const;
  /// The default as a user would write it.
  std::string initial_text() const;
};

/// What a schedule says about itself.
struct ScheduleInfo {
  std::string name;                           ///< as Options::schedule names it
  std::string description;                    ///< what it does, one line
  std::vector<ScheduleParameter> parameters;  ///< in the order of the script
};

/// The schedules that tetmend brings along; the first is the default.
TETMEND_API std::vector<ScheduleInfo> schedules();

/// A schedule by its name or its file.
/// @param name_or_file as Options::schedule
/// @throws Error for an unknown name, a file that cannot be read, or a mistake in the script.
TETMEND_API ScheduleInfo describe_schedule(const std::string& name_or_file);

/// The text of the script. @throws Error as describe_schedule(), mistakes excepted.
TETMEND_API std::string schedule_source(const std::string& name_or_file);

/// An operator as a script can name it: `apply{"smoothing", steps = 8}`.
struct OperatorDescription {
  /// A parameter of the operator.
  struct Parameter {
    /// What values it takes; a flag is 0 or 1.
    enum class Kind : std::uint8_t { integer, real, flag };
    std::string name;        ///< as in a script
    Kind kind = Kind::real;  ///< what values it takes
    double low = 0;          ///< the least value
    double high = 0;         ///< the greatest value
    double initial = 0;      ///< the default
    std::string help;        ///< what it is for, one line
  };
  std::string name;                   ///< as in a script
  std::string target;                 ///< what it works on: "tet", "edge", "face" or "vertex"
  std::string help;                   ///< what it does, one line
  std::filesystem::path plugin;       ///< where it comes from; empty: from tetmend itself
  std::vector<Parameter> parameters;  ///< in the order of the operator
};

/// The operators of tetmend, then those of the plugins, in their order.
/// @throws Error for a plugin that cannot be loaded.
TETMEND_API std::vector<OperatorDescription> operators(
    const std::vector<std::filesystem::path>& plugins = {});

/// The version of the library that runs: "0.1.0".
TETMEND_API std::string_view version();

}  // namespace tetmend
