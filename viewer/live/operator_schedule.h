// SPDX-License-Identifier: MIT
// A schedule of one operator, with the operator's parameters as its own: to try an operator, above
// all one of a plugin.
#pragma once

#include <string>
#include <string_view>

#include "ops/registry.h"
#include "schedule/schedule.h"

namespace tetmend::viewer {

/// How it is called: "operator NAME".
inline constexpr std::string_view kOperatorPrefix = "operator ";

/// The operator is tried on the bad tets, several rounds if so set.
Schedule operator_schedule(const OperatorInfo& info);

/// Schedule::find(), or for a name that begins with kOperatorPrefix the schedule of that operator.
/// @throws Error as Schedule::find() and Registry::find().
Schedule find_schedule(const Registry& registry, const std::string& name);

}  // namespace tetmend::viewer
