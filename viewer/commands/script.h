// SPDX-License-Identifier: MIT
// Scripts that drive the viewer by its own commands, for tests, lectures and figures.
#pragma once

#include <filesystem>
#include <string>

#include "viewer/commands/commands.h"

namespace tetmend::viewer {

/// Runs the text of a Lua script, in the box of schedule/lua_state.h, with the commands as words.
/// `name` is what errors call it. Ends early at quit().
/// @throws Error "NAME:LINE: reason", also when an expectation does not hold.
void run_script(Session& session, const std::string& text, const std::string& name);

/// @throws Error as run_script(), or when the file cannot be read.
void run_script_file(Session& session, const std::filesystem::path& file);

}  // namespace tetmend::viewer
