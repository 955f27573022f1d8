// SPDX-License-Identifier: MIT
// Options of a run that a file of the folder holds: tetmend.conf, where the command runs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace tetmend::apps {

inline constexpr std::string_view kFolderFile = "tetmend.conf";

/// A line of the file.
struct FolderOption {
  std::size_t line = 0;  ///< from 1
  std::string argument;  ///< "--goal=35"
};

/// The file, where there is one and the command reads it; else empty.
/// @param app has parsed the command line
std::filesystem::path folder_file(const CLI::App& app);

/// What the file adds to the command line, in its order. Left out are options that the command line
/// has or excludes, and those that do nothing there: of another command, or without an option that they need.
/// @param app has parsed the command line; nothing comes of other commands than improve and adapt,
/// of --no-config, and where there is no such file
/// @throws UsageError with the line that is none; Error where the file cannot be read
std::vector<FolderOption> folder_options(const CLI::App& app);

}  // namespace tetmend::apps
