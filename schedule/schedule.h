// SPDX-License-Identifier: MIT
// A schedule: a script that says which passes are made over a mesh, in which order, until when.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "schedule/passes.h"
#include "schedule/schedule_parameter.h"

namespace tetmend {

/// @throws Error for an unknown name or a value of wrong type or range, with what is valid.
void check_settings(const ScheduleInfo& info, const ScheduleSettings& settings);

/// The text of a script.
/// @throws Error when the file cannot be read, or is too large.
std::string read_script(const std::filesystem::path& file);

/// The text of a Lua script and its name. docs/schedules.md describes the language.
class Schedule {
 public:
  /// @param name what errors call it
  Schedule(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}
  /// One of those that tetmend brings along.
  /// @throws Error for an unknown name, with the valid ones.
  static Schedule builtin(std::string_view name);
  /// @throws Error when the file cannot be read.
  static Schedule from_file(const std::filesystem::path& file);
  /// A name with the extension .lua is a file, any other a builtin schedule.
  /// @throws Error as those do.
  static Schedule find(const std::string& name_or_file);

  const std::string& name() const { return name_; }
  const std::string& text() const { return text_; }

  /// Runs the script up to its first pass.
  /// @throws Error "NAME:LINE: reason" for a mistake so far.
  ScheduleInfo describe() const;

 private:
  std::string name_;
  std::string text_;
};

/// Names of the schedules that tetmend brings along; the first is the default.
std::vector<std::string_view> builtin_schedule_names();

/// Runs a schedule. Returns early, without an error, when the run is cancelled or out of time. The
/// default schedule is Algorithm 6 of the paper; it never changes the surface.
/// @throws Error "NAME:LINE: reason" for a mistake in the script; the mesh is sound all the same.
void improve(Run& run, const Schedule& schedule, const ScheduleSettings& settings = {});
void improve(Run& run);

}  // namespace tetmend
