// SPDX-License-Identifier: MIT
// Which plugins a command works with.
#pragma once

#include <filesystem>
#include <vector>

#include "ops/registry.h"

namespace CLI {
class App;
}

namespace tetmend::apps {

/// Adds --plugin FILE, which may be repeated.
void add_plugin_option(CLI::App& command, std::vector<std::filesystem::path>& plugins);

/// The operators of tetmend, then those of the plugins that TETMEND_PLUGIN_PATH names (files, and
/// folders for all *.so in them by name; separated by colons), then those of `plugins`. A file that
/// is named twice is loaded once.
/// @throws Error for a plugin that cannot be loaded, or a place that does not exist.
Registry load_operators(const std::vector<std::filesystem::path>& plugins);

}  // namespace tetmend::apps
