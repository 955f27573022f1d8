// SPDX-License-Identifier: MIT
// Names of programs, for people.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace tetmend {

/// "edge_removal" as "edge removal".
inline std::string spaced(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace tetmend
