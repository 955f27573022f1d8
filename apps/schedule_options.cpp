// SPDX-License-Identifier: MIT
#include "apps/schedule_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/commands.h"

namespace tetmend::apps {
namespace {

ScheduleSettings split_settings(const std::vector<std::string>& texts) {
  ScheduleSettings settings;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw UsageError(fmt::format("--set: '{}' is not of the form NAME=VALUE", text));
    }
    settings.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return settings;
}

}  // namespace

void add_schedule_options(CLI::App& command, ScheduleOptions& options) {
  options.schedule = builtin_schedule_names().front();
  command
      .add_option("--schedule", options.schedule,
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
      .add_option("--time-limit", options.time_limit,
                  "Stop improving after that time and\nwrite what was reached")
      ->type_name("SECONDS")
      ->check(CLI::Range(1e-3, 1e9).description(""));
}

ChosenSchedule choose_schedule(const ScheduleOptions& options) {
  const ScheduleSettings settings = split_settings(options.settings);
  const bool is_file = std::filesystem::path(options.schedule).extension() == ".lua";
  try {
    Schedule schedule = Schedule::find(options.schedule);
    const ScheduleInfo info = schedule.describe();  // finds mistakes before the mesh is read
    try {
      check_settings(info, settings);
    } catch (const Error& error) {
      throw UsageError(fmt::format("--set: {}", error.what()));
    }
    return {std::move(schedule), settings};
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    if (is_file) throw;
    throw UsageError(fmt::format("--schedule: {}", error.what()));
  }
}

}  // namespace tetmend::apps
