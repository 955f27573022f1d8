// SPDX-License-Identifier: MIT
// Which plugins a command works with.
#pragma once

#include <filesystem>
#include <vector>

namespace CLI {
class App;
}

namespace tetmend::apps {

/// Adds --plugin FILE, which may be repeated.
void add_plugin_option(CLI::App& command, std::vector<std::filesystem::path>& plugins);

/// The plugins that TETMEND_PLUGIN_PATH names (files, and folders for all *.so in them by name;
/// separated by colons), then `plugins`.
/// @throws Error for a place that does not exist.
std::vector<std::filesystem::path> all_plugins(const std::vector<std::filesystem::path>& plugins);

}  // namespace tetmend::apps
