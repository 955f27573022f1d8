// SPDX-License-Identifier: MIT
// Paragraphs in panels.
#pragma once

#include <string_view>

namespace tetmend::viewer::ui {

/// Like ImGui::TextWrapped, but breaks lines at spaces only: never inside a number.
void wrapped_text(std::string_view text);

}  // namespace tetmend::viewer::ui
