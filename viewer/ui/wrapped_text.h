// SPDX-License-Identifier: MIT
// Paragraphs in panels.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace tetmend::viewer::ui {

/// Like ImGui::TextWrapped, but breaks lines at spaces only: never inside a number.
void wrapped_text(std::string_view text);

/// What the mouse does to the calls that a paragraph names.
struct CallsInText {
  std::optional<std::uint32_t> clicked, hovered;
};
/// The same; each "call 17" in it is a link.
CallsInText wrapped_text_with_calls(std::string_view text);

}  // namespace tetmend::viewer::ui
