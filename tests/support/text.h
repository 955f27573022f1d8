// SPDX-License-Identifier: MIT
// What tests ask of a text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

namespace tetmend::test {

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// The text with another part in the place of the first one like `what`, which must be there.
inline std::string replaced(std::string_view text, std::string_view what, std::string_view by) {
  std::string result(text);
  const std::size_t at = result.find(what);
  REQUIRE_MESSAGE(at != std::string::npos, what);
  return result.replace(at, what.size(), by);
}

/// How often a part is in the text.
inline std::size_t count_of(std::string_view text, std::string_view part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

}  // namespace tetmend::test
