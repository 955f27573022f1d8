// SPDX-License-Identifier: MIT
#include "viewer/ui/dialog_buttons.h"

#include <imgui.h>

namespace tetmend::viewer::ui {

bool is_escape() {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
}

void close_by_escape() {
  if (is_escape()) ImGui::CloseCurrentPopup();
}

bool begin_submenu(const char* title, bool is_possible) {
  return !is_escape() && ImGui::BeginMenu(title, is_possible);
}

Answer dialog_buttons(const char* accept, bool is_entered, const std::string& trouble) {
  const bool is_accepted = ImGui::Button(accept) || is_entered;
  ImGui::SameLine();
  const bool is_cancelled = ImGui::Button("Cancel") || is_escape();
  if (!trouble.empty()) ImGui::TextWrapped("%s", trouble.c_str());
  return is_cancelled ? Answer::cancelled : is_accepted ? Answer::accepted : Answer::none;
}

}  // namespace tetmend::viewer::ui
