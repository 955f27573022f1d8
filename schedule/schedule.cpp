// SPDX-License-Identifier: MIT
#include "schedule/schedule.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/nearest_word.h"
#include "schedule/builtin_schedules.h"
#include "schedule/script_host.h"

namespace tetmend {

namespace {

constexpr std::size_t kLargestScript = std::size_t{1} << 20;

template <class Named>
std::string names_of(const Named& all) {
  std::string names;
  for (const auto& each : all) names += (names.empty() ? "" : ", ") + std::string(each.name);
  return names.empty() ? "none" : names;
}

}  // namespace

Schedule Schedule::builtin(std::string_view name) {
  for (const BuiltinSchedule& schedule : builtin_schedules()) {
    if (schedule.name == name) return {std::string(name), std::string(schedule.text)};
  }
  throw Error(fmt::format("there is no schedule '{}': expected {}, or the name of a .lua file{}",
                          name, names_of(builtin_schedules()),
                          guess_of(name, names_of(builtin_schedules()))));
}

std::string read_script(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.good() && !in.eof()) throw Error(fmt::format("{}: cannot read it", file.string()));
  if (text.size() > kLargestScript) {
    throw Error(fmt::format("{}: too large for a script", file.string()));
  }
  return text;
}

Schedule Schedule::from_file(const std::filesystem::path& file) {
  return {file.string(), read_script(file)};
}

Schedule Schedule::find(const std::string& name_or_file) {
  const std::filesystem::path path = name_or_file;
  return path.extension() == ".lua" ? from_file(path) : builtin(name_or_file);
}

ScheduleInfo Schedule::describe() const {
  const ScheduleSettings none;
  ScriptHost host(nullptr, none);
  host.execute(*this);
  return host.info();
}

std::vector<std::string_view> builtin_schedule_names() {
  std::vector<std::string_view> names;
  for (const BuiltinSchedule& schedule : builtin_schedules()) names.push_back(schedule.name);
  return names;
}

void check_settings(const ScheduleInfo& info, const ScheduleSettings& settings) {
  for (const auto& [name, value] : settings) {
    const bool known =
        std::any_of(info.parameters.begin(), info.parameters.end(),
                    [&wanted = name](const auto& parameter) { return parameter.name == wanted; });
    if (!known) {
      throw Error(fmt::format("schedule {} has no parameter '{}'; valid: {}{}", info.name, name,
                              names_of(info.parameters),
                              guess_of(name, names_of(info.parameters))));
    }
  }
  for (const ScheduleParameter& parameter : info.parameters) chosen_value(parameter, settings);
}

void improve(Run& run, const Schedule& schedule, const ScheduleSettings& settings) {
  ScriptHost(&run, settings).execute(schedule);
}

void improve(Run& run) {
  improve(run, Schedule::builtin(builtin_schedules().front().name));
}

}  // namespace tetmend
