// SPDX-License-Identifier: MIT
// The texts of the schedules that tetmend brings along: assets/schedules/NAME.lua.
#pragma once

#include <span>
#include <string_view>

namespace tetmend {

struct BuiltinSchedule {
  std::string_view name;
  std::string_view text;
};

/// The default first, then by name.
std::span<const BuiltinSchedule> builtin_schedules();

}  // namespace tetmend
