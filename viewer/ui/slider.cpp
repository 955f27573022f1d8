// SPDX-License-Identifier: MIT
#include "viewer/ui/slider.h"

#include <algorithm>
#include <array>
#include <string>

#include <imgui_internal.h>

namespace tetmend::viewer::ui {

namespace {

std::string number_text(ImGuiDataType type, const void* value, const char* format) {
  std::array<char, 64> text{};
  ImGui::DataTypeFormatString(text.data(), static_cast<int>(text.size()), type, value, format);
  return text.data();
}

}  // namespace

bool slider(const char* id, ImGuiDataType type, void* value, const void* low, const void* high,
            const char* format, ImGuiSliderFlags flags, const char* text) {
  const float whole = ImGui::CalcItemWidth();
  float wide = text == nullptr ? 0 : ImGui::CalcTextSize(text).x;
  for (const void* each : {low, high, static_cast<const void*>(value)}) {
    wide = std::max(wide, ImGui::CalcTextSize(number_text(type, each, format).c_str()).x);
  }
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(std::max(whole - wide - gap, 3 * ImGui::GetFontSize()));
  // Its own number would be under the grip; typed after Ctrl + click it is to be seen.
  const bool is_typed = ImGui::TempInputIsActive(ImGui::GetID(id));
  const ImVec4 ink = ImGui::GetStyleColorVec4(ImGuiCol_Text);
  ImGui::PushStyleColor(ImGuiCol_Text, is_typed ? ink : ImVec4{ink.x, ink.y, ink.z, 0});
  const bool is_changed = ImGui::SliderScalar(id, type, value, low, high, format, flags);
  ImGui::PopStyleColor();
  const ImVec2 corner = ImGui::GetItemRectMax();
  const std::string now = text == nullptr ? number_text(type, value, format) : text;
  const float left = corner.x + gap + wide - ImGui::CalcTextSize(now.c_str()).x;
  const float top = corner.y - ImGui::GetStyle().FramePadding.y - ImGui::GetFontSize();
  ImGui::GetWindowDrawList()->AddText({left, top}, ImGui::GetColorU32(ink), now.c_str());
  return is_changed;
}

}  // namespace tetmend::viewer::ui
