// SPDX-License-Identifier: MIT
// What is wrong with a number on the command line, in the words of the library.
#pragma once

#include <string>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace tetmend::apps {

/// For an option: its value is a number from `low` to `high`.
template <class Number>
CLI::Validator number_from(Number low, Number high) {
  const auto complaint = [low, high](const std::string& text) -> std::string {
    Number number{};
    const bool is_number = CLI::detail::lexical_cast(text, number);
    if (is_number && number >= low && number <= high) return {};
    constexpr const char* kWhat = std::is_integral_v<Number> ? "a whole number" : "a number";
    return fmt::format("'{}' is not {} from {} to {}", text, kWhat, low, high);
  };
  return {complaint, ""};
}

}  // namespace tetmend::apps
