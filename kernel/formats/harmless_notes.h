// SPDX-License-Identifier: MIT
// Notes of readers that tell of no loss: by the words that they end with.
#pragma once

#include <string_view>

namespace tetmend::formats {

/// What is kept, but must be known.
inline constexpr std::string_view kStayWhereTheyAre = "they stay as they are, and where they are";
/// What is lost only where tets are replaced.
inline constexpr std::string_view kMustBeMadeAnew =
    "where improving replaces them it must be made anew";
inline constexpr std::string_view kMayBeGone = "an improved mesh may not have it";

/// @param replaces_tets what follows the reading
inline bool loses_nothing(std::string_view note, bool replaces_tets) {
  if (note.ends_with(kStayWhereTheyAre)) return true;
  return !replaces_tets && (note.ends_with(kMustBeMadeAnew) || note.ends_with(kMayBeGone));
}

}  // namespace tetmend::formats
