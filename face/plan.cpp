// SPDX-License-Identifier: MIT
#include "face/plan.h"

#include <filesystem>

#include <fmt/format.h>

#include "face/arena.h"
#include "face/regions.h"
#include "face/registry.h"

namespace tetmend::face {

namespace {

Schedule find_schedule(const Options& options) {
  if (!options.script.empty()) return {"script", options.script};
  if (std::filesystem::path(options.schedule).extension() == ".lua") {
    return Schedule::from_file(options.schedule);
  }
  try {
    return Schedule::builtin(options.schedule);
  } catch (const Error& error) {
    throw OptionError("schedule", fmt::format("schedule: {}", error.what()));
  }
}

}  // namespace

void check_goal(const Goal& goal) {
  if (is_sound(goal)) return;
  throw OptionError("goal", fmt::format("goal: {},{} is no goal: the smallest angle is above 0 "
                                        "and at most 70 degrees, the largest 71 to below 180",
                                        goal.min_angle, goal.max_angle));
}

Plan::Plan(const Options& options)
    : registry(load_registry(options.plugin, options.operators)),
      schedule(find_schedule(options)),
      trace(options, registry),
      purpose(find_purpose(options)),
      settings(settings_of(options)),
      growth(tets_of(options), least_growth_of(options)),
      surface(options),
      sizes(options) {
  check_threads(options.threads);
  check_regions(options);
  check_goal(options.goal);
  try {
    standard = registry.standard(options.measure, options.goal, 0);
    const bool has_price = standard.terms() != Standard::Terms::sine;
    standard = standard.with_price(has_price ? Standard::kUsualPrice : 0);
  } catch (const Error& error) {
    throw OptionError("measure", fmt::format("measure: {}", error.what()));
  }
  if (!(options.time_limit >= 0)) {
    throw OptionError("time_limit", fmt::format("time_limit: {} is no time", options.time_limit));
  }
  const ScheduleInfo info = schedule.describe();
  try {
    check_settings(info, options.set);
  } catch (const Error& error) {
    throw OptionError("set", fmt::format("set: {}", error.what()));
  }
}

}  // namespace tetmend::face
