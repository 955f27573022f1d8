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

enum class Answer : std::uint8_t { none, accepted, cancelled };

/// Inside a popup. Escape cancels, too. `is_entered`: it was accepted by the keyboard.
Answer dialog_buttons(const char* accept, bool is_entered, const std::string& trouble);

}  // namespace tetmend::viewer::ui
