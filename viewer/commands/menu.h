// SPDX-License-Identifier: MIT
// Commands as menus have them: in few words, and greyed where they would do nothing.
#pragma once

#include <optional>
#include <string>

#include "viewer/commands/commands.h"

namespace tetmend::viewer {

/// "Open ...", "Step over": without full sentences, and without what is for scripts.
std::string menu_text(const Command& command);

/// A menu has a line before it: what follows is of another kind.
bool begins_group(const Command& command);

/// Of what is on or off, which of them it is; nothing of other commands. For ticks.
std::optional<bool> is_on(const Command& command, const Document& document);

/// False where the command would only complain: without a mesh, a trace, a run, a selection.
bool is_possible(const Command& command, Document& document);

}  // namespace tetmend::viewer
