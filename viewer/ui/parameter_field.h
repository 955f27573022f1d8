// SPDX-License-Identifier: MIT
// A field for a parameter of an operator.
#pragma once

#include <optional>

#include "viewer/live/live_run.h"

namespace tetmend::viewer::ui {

/// Under the name of the parameter, with its help. The new value, within its bounds, once the user
/// has let go of it.
std::optional<double> edit_value(const ParameterSpec& spec, double value);

}  // namespace tetmend::viewer::ui
