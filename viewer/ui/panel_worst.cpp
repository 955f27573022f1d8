// SPDX-License-Identifier: MIT
// The worst tets by the chosen measure; a click goes there.
#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "kernel/spaced.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

void draw_worst_panel(Session& session) {
  Document& document = session.document;
  constexpr ImGuiTableFlags kLooks = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
  constexpr float kRows = 10.2F;  // and more where the column would be empty
  const float height = kRows * ImGui::GetTextLineHeightWithSpacing() + spare_room();
  if (!ImGui::BeginTable("##worst", 3, kLooks, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  // As wide as the longest number needs.
  const std::string longest = fmt::format("{}", document.mesh().tet_slots());
  const float rank = ImGui::CalcTextSize("100 ").x;
  const float number =
      std::max(ImGui::CalcTextSize(longest.c_str()).x, ImGui::CalcTextSize("tet").x);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, rank);
  ImGui::TableSetupColumn("tet", ImGuiTableColumnFlags_WidthFixed, number);
  ImGui::TableSetupColumn(spaced(document.view.scene.measure).c_str(),
                          ImGuiTableColumnFlags_WidthStretch);
  headers_row(1);
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
    right_aligned(fmt::format("{}", worst[i].index()));
    ImGui::TableNextColumn();
    right_aligned(fmt::format("{:.5f}", values[worst[i].index()]));
  }
  ImGui::EndTable();
}

}  // namespace tetmend::viewer::ui
