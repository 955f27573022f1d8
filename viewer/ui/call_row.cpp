// SPDX-License-Identifier: MIT
#include "viewer/ui/call_row.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui_internal.h>

#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

std::string numbers_of(const Call& call) {
  std::string text;
  for (const VertexHandle v : call.target()) {
    text += fmt::format("{}{}", text.empty() ? "" : "-", v.index());
  }
  return text;
}

bool fitted_row(const std::string& text, bool is_selected, ImGuiSelectableFlags flags) {
  constexpr float kSmallest = 0.8F;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float room = ImGui::GetContentRegionAvail().x;
  const bool is_clicked =
      ImGui::Selectable(("##" + text).c_str(), is_selected, flags, {0, ImGui::GetTextLineHeight()});
  const auto width = [](const std::string& shown) { return ImGui::CalcTextSize(shown.c_str()).x; };
  const float share = std::clamp(room / std::max(width(text), 1.0F), kSmallest, 1.0F);
  std::string shown = text;
  for (std::size_t cut = text.size(); share * width(shown) > room && cut > 0;) {
    shown = text.substr(0, --cut) + "...";
  }
  const float size = share * ImGui::GetFontSize();
  ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), size,
                                      {at.x, at.y + (ImGui::GetFontSize() - size) / 2},
                                      ImGui::GetColorU32(ImGuiCol_Text), shown.c_str());
  return is_clicked;
}

bool wrapped_row(const std::string& text, bool is_selected, ImGuiSelectableFlags flags) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const std::string lines = in_lines(text, ImGui::GetContentRegionAvail().x);
  const float height = ImGui::CalcTextSize(lines.c_str()).y;
  const bool is_clicked = ImGui::Selectable(("##" + text).c_str(), is_selected, flags, {0, height});
  ImGui::GetWindowDrawList()->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), lines.c_str());
  return is_clicked;
}

namespace {

/// Of the column, from within any of its panels.
float* spare_of_column() {
  return ImGui::GetStateStorage()->GetFloatRef(ImHashStr("##spare"), 0);
}

}  // namespace

void tooltip_below(const std::string& text) {
  if (!ImGui::IsItemHovered()) return;
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::SetNextWindowPos({ImGui::GetMousePos().x + ImGui::GetFontSize(),
                           ImGui::GetItemRectMax().y + style.ItemSpacing.y});
  ImGui::SetTooltip("%s", text.c_str());
}

float spare_room() {
  return *spare_of_column();
}

void note_spare_room() {
  float* spare = spare_of_column();
  *spare =
      std::max(*spare + ImGui::GetContentRegionAvail().y - ImGui::GetStyle().ItemSpacing.y, 0.0F);
}

}  // namespace tetmend::viewer::ui
