// SPDX-License-Identifier: MIT
// Options of a run that a file of the folder holds: tetmend.conf, where the command runs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace tetmend::apps {

inline constexpr std::string_view kFolderFile = "tetmend.conf";

/// What the file adds to the command line: "--goal=35", in its order. Options that the command line
/// has are left out.
/// @param app has parsed the command line; nothing comes of other commands than improve and adapt,
/// of --no-config, and where there is no such file
/// @throws UsageError with the line that is none
std::vector<std::string> folder_options(const CLI::App& app);

}  // namespace tetmend::apps
