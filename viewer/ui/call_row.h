// SPDX-License-Identifier: MIT
// Rows of lists that name calls, and columns that use what room there is.
#pragma once

#include <string>
#include <string_view>

#include <imgui.h>

#include "explain/event_text.h"

namespace tetmend::viewer::ui {

/// The target without its kind, which follows from the operator: "3-17".
std::string numbers_of(const Call& call);

/// Like ImGui::Selectable, with `text` as its name. Text that is too wide is smaller, and what is too
/// wide still ends in dots.
bool fitted_row(const std::string& text, bool is_selected, ImGuiSelectableFlags flags = 0);
/// The same in as many lines as the text needs: nothing of it is smaller or cut.
bool wrapped_row(const std::string& text, bool is_selected, ImGuiSelectableFlags flags = 0);

/// A tooltip below the last item, if the mouse is on that: the row itself stays in sight.
void tooltip_below(const std::string& text);

/// What the current column has left below its last panel: for the one list that takes it.
float spare_room();
/// At the end of a column.
void note_spare_room();

}  // namespace tetmend::viewer::ui
