// SPDX-License-Identifier: MIT
// The schedules and their language, described from what the program itself knows.
#pragma once

#include <string>

#include "schedule/schedule.h"

namespace tetmend {

/// Name and description, at most 80 columns wide.
std::string format_summary(const ScheduleInfo& info);
/// The same and the parameters.
std::string format_parameters(const ScheduleInfo& info);
/// The words that scripts can call, for people.
std::string format_words();
/// All words and builtin schedules as the generated part of docs/schedules.md.
std::string format_reference();

}  // namespace tetmend
