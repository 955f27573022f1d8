// SPDX-License-Identifier: MIT
// What is known of the picked tet, edge or vertex, with a legend of the colours of a shell.
#include <imgui.h>

#include "viewer/ui/panels.h"

namespace tetmend::viewer::ui {

namespace {

void legend(const char* text, const Colour& c) {
  const ImVec4 tint(static_cast<float>(c.red) / 255, static_cast<float>(c.green) / 255,
                    static_cast<float>(c.blue) / 255, 1);
  ImGui::ColorButton(text, tint, ImGuiColorEditFlags_NoTooltip,
                     {ImGui::GetFontSize(), 0.6F * ImGui::GetFontSize()});
  ImGui::SameLine();
  ImGui::TextUnformatted(text);
}

}  // namespace

void draw_selection_panel(Session& session) {
  const Document& document = session.document;
  const Rows rows = describe(document.mesh(), document.selection());
  if (rows.empty()) {
    ImGui::TextDisabled("click a tet, an edge or a vertex");
    return;
  }
  if (ImGui::BeginTable("##selection", 2, ImGuiTableFlags_RowBg)) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 7.5F * ImGui::GetFontSize());
    for (const auto& row : rows) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", row.first.c_str());
      ImGui::TableNextColumn();
      ImGui::TextWrapped("%s", row.second.c_str());
    }
    ImGui::EndTable();
  }
  if (!std::holds_alternative<TetEdge>(document.selection())) return;
  legend("supporting edge and faces", kSupportingEdgeColour);
  legend("skirt polygon", kSkirtColour);
  legend("link faces", kLinkFaceColour);
}

}  // namespace tetmend::viewer::ui
