// SPDX-License-Identifier: MIT
// What a parser knows of its program, as data: man pages and completions are made of it, by apps/manual.
#pragma once

#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace CLI {
class App;
}

namespace tetmend::apps {

/// The one argument that asks for it.
inline constexpr std::string_view kDescribe = "--help-json";

/// Options, commands and texts of --help, all in the order of help.
/// @param version of the program
nlohmann::json describe(const CLI::App& app, std::string_view version);

}  // namespace tetmend::apps
