// SPDX-License-Identifier: MIT
// Short lists of words that a format knows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace tetmend::formats {

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace tetmend::formats
