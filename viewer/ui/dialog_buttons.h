// SPDX-License-Identifier: MIT
// The end of a dialog: a button that accepts, one that cancels, and what was wrong.
#pragma once

#include <cstdint>
#include <string>

namespace tetmend::viewer::ui {

/// Inside a popup or a menu: Escape closes it.
void close_by_escape();
/// The key has just been pressed.
bool is_escape();
/// A menu in a menu or popup, which close_by_escape() closes. As ImGui::BeginMenu(); not while that closes it:
/// under the mouse it would open again, without what it belongs to, and keep all keys.
bool begin_submenu(const char* title, bool is_possible = true);

enum class Answer : std::uint8_t { none, accepted, cancelled };

/// Inside a popup. Escape cancels, too. `is_entered`: it was accepted by the keyboard.
Answer dialog_buttons(const char* accept, bool is_entered, const std::string& trouble);

}  // namespace tetmend::viewer::ui
