// SPDX-License-Identifier: MIT
// The files that a deck includes, by the names that it has for them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tetmend::formats {

/// Where the file that a deck calls `name` is, seen from the folder of the deck. Quotes around the name
/// are no part of it; where there is no such file, backslashes part folders, as on Windows.
std::filesystem::path included_path(const std::filesystem::path& folder, std::string_view name);

/// The same for all names of one file, links followed; never throws.
std::filesystem::path place_of_included(const std::filesystem::path& path);

/// What to tell of a deck whose lines name files beside it, one sentence or none.
/// @param folder that the deck lay in; empty: no line does
/// @param file   that is written
/// @param keyword  of these lines
std::vector<std::string> included_files_stay(const std::filesystem::path& file,
                                             const std::string& folder, std::string_view keyword);

}  // namespace tetmend::formats
