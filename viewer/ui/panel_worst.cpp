// SPDX-License-Identifier: MIT
// The worst tets by the chosen measure; a click goes there.
#include <fmt/format.h>
#include <imgui.h>

#include "viewer/ui/panels.h"

namespace tetmend::viewer::ui {

void draw_worst_panel(Session& session) {
  Document& document = session.document;
  constexpr ImGuiTableFlags kLooks = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
  constexpr float kRows = 10.2F;  // always as many, so that no row moves away from the mouse
  const float height = kRows * ImGui::GetTextLineHeightWithSpacing();
  if (!ImGui::BeginTable("##worst", 3, kLooks, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.25F);
  ImGui::TableSetupColumn("tet", ImGuiTableColumnFlags_WidthStretch, 0.35F);
  ImGui::TableSetupColumn(document.view.scene.measure.c_str());
  ImGui::TableHeadersRow();
  const auto place = document.place_among_worst();
  const auto values = document.values();
  const std::vector<TetHandle> worst = document.worst();
  for (std::size_t i = 0; i < worst.size(); ++i) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable(fmt::format("{}", i + 1).c_str(), place == i,
                          ImGuiSelectableFlags_SpanAllColumns)) {
      guarded(document, [&] { document.fly_to_worst(i); });
    }
    if (ImGui::IsItemHovered()) {
      const TetVertices& v = document.mesh().vertices(worst[i]);
      document.hovering = {{v.begin(), v.end()}};
    }
    ImGui::TableNextColumn();
    ImGui::Text("%u", worst[i].index());
    ImGui::TableNextColumn();
    ImGui::Text("%.5f", static_cast<double>(values[worst[i].index()]));
  }
  ImGui::EndTable();
}

}  // namespace tetmend::viewer::ui
