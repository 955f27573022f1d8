// SPDX-License-Identifier: MIT
// What tests ask of a text.
#pragma once

#include <string_view>

namespace tetmend::test {

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace tetmend::test
