// SPDX-License-Identifier: MIT
// Parameters that schedules declare, and the values that users give them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <tetmend/catalogue.h>

#include "schedule/script_value.h"

namespace tetmend {

/// Values of parameters as a user writes them: "10", "true", "grummp".
using ScheduleSettings = std::vector<std::pair<std::string, std::string>>;

/// Reads what a script hands to `parameter`: {"name", default = 1, low = 0, high = 10, help = ""}.
/// @throws Error naming what is wrong.
ScheduleParameter read_parameter(const ScriptValue& value,
                                 const std::vector<ScheduleParameter>& earlier);

/// The value of a parameter: the last setting of its name, or the default. A number (0 or 1 of a
/// flag), or the text of a choice.
/// @throws Error for a value of the wrong type or out of range.
std::pair<double, std::string> chosen_value(const ScheduleParameter& parameter,
                                            const ScheduleSettings& settings);

}  // namespace tetmend
