// SPDX-License-Identifier: MIT
// Large numbers as people read them.
#pragma once

#include <cstddef>
#include <string>

namespace tetmend::face {

/// 1234567 as 1,234,567.
inline std::string grouped(std::size_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

}  // namespace tetmend::face
