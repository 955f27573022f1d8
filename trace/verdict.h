// SPDX-License-Identifier: MIT
// The answer of an operator, which users see.
#pragma once

#include <optional>
#include <string_view>

#include <tetmend/verdict.h>

namespace tetmend {

/// The inverse; nothing for a text that is no verdict.
constexpr std::optional<Verdict> verdict_of(std::string_view text) {
  for (std::size_t i = 0; i < kVerdictCount; ++i) {
    const auto verdict = static_cast<Verdict>(i);
    if (to_string(verdict) == text) return verdict;
  }
  return std::nullopt;
}

}  // namespace tetmend
