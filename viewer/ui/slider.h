// SPDX-License-Identifier: MIT
// A slider with its number beside it: no grip lies on that.
#pragma once

#include <imgui.h>

namespace tetmend::viewer::ui {

/// Like ImGui::SliderScalar; with the number it is as wide as an item would be, see
/// ImGui::SetNextItemWidth(). The last item is the slider. `text`: what stands there instead.
bool slider(const char* id, ImGuiDataType type, void* value, const void* low, const void* high,
            const char* format, ImGuiSliderFlags flags = 0, const char* text = nullptr);

}  // namespace tetmend::viewer::ui
