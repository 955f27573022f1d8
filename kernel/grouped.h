// SPDX-License-Identifier: MIT
// Numbers as people read them.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include <fmt/format.h>

namespace tetmend {

/// 1234567 as 1,234,567.
inline std::string grouped(std::size_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

/// Fixed notation; scientific where that would leave fewer than two digits of a small number, or
/// print more than a table has room for.
inline std::string decimal(double value, int digits) {
  if (value == 0) return "0";
  if (std::isnan(value)) return "nan";  // fmt would print the sign bit as well
  const bool tiny = std::abs(value) < 10 * std::pow(10.0, -digits);
  const bool huge = std::abs(value) >= 1e9;
  return tiny || huge ? fmt::format("{:.3g}", value) : fmt::format("{:.{}f}", value, digits);
}

}  // namespace tetmend
