// SPDX-License-Identifier: MIT
// What a plugin was built against, read from its file, before any of its code can run.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "ops/plugin.h"

namespace tetmend {

inline constexpr const char* kPluginAbiSymbol = "tetmend_plugin_abi";

/// What the symbol `tetmend_plugin_abi` of a shared library says. Nothing if the file is not there, is
/// no library for this machine, or if this system's libraries are not understood: loading it tells why.
/// @throws Error for what is no regular file, for a file that was cut, and for a library that has no
/// such symbol with a value
/// Cost: reads the heads, the table of dynamic symbols and eight bytes.
std::optional<PluginAbi> read_plugin_abi(const std::filesystem::path& file);

/// @throws Error: the library has no such symbol
[[noreturn]] void throw_no_symbol(const std::filesystem::path& file, std::string_view symbol);

}  // namespace tetmend
