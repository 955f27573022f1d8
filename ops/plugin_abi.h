// SPDX-License-Identifier: MIT
// What a plugin was built against, read from its file, before any of its code can run.
#pragma once

#include <filesystem>
#include <optional>

#include "ops/plugin.h"

namespace tetmend {

/// What the symbol `tetmend_plugin_abi` of a shared library says. Nothing if the file cannot be read,
/// is no library for this machine, or has no such symbol with a value: loading it tells why.
/// Cost: reads the head, the table of dynamic symbols and eight bytes.
std::optional<PluginAbi> read_plugin_abi(const std::filesystem::path& file);

}  // namespace tetmend
