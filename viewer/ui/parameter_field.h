// SPDX-License-Identifier: MIT
// A field for a parameter of an operator.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "viewer/live/live_run.h"

namespace tetmend::viewer::ui {

/// The name stands left of the field that comes next, with spaces; scripts and schedules have low
/// lines. Gives what the field is called.
std::string name_field(std::string_view name);

/// Under the name of the parameter, with its help. The new value, within its bounds, once the user
/// has let go of it.
std::optional<double> edit_value(const ParameterSpec& spec, double value);

}  // namespace tetmend::viewer::ui
