// SPDX-License-Identifier: MIT
// Where bad tets are many; a click goes there.
#include <fmt/format.h>
#include <imgui.h>

#include "kernel/grouped.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

void draw_places_panel(Session& session) {
  Document& document = session.document;
  constexpr ImGuiTableFlags kLooks = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
  constexpr float kRows = 8.2F;
  const float height = kRows * ImGui::GetTextLineHeightWithSpacing();
  if (!ImGui::BeginTable("##places", 3, kLooks, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("bad tets", ImGuiTableColumnFlags_WidthStretch);
  number_column("of all", "100 %");
  number_column("worst", "0.0000");
  headers_row(1);
  const auto places = document.bad_places();  // a click moves the camera alone
  const auto most = static_cast<float>(places.empty() ? 1 : places.front().bad);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const BadPlace& place = places[i];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(static_cast<int>(i));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x * static_cast<float>(place.bad) / most;
    ImGui::GetWindowDrawList()->AddRectFilled(
        corner, {corner.x + width, corner.y + ImGui::GetTextLineHeight()},
        IM_COL32(214, 39, 40, 70));
    if (ImGui::Selectable(grouped(place.bad).c_str(), false, ImGuiSelectableFlags_SpanAllColumns)) {
      document.fly_to_place(i);
    }
    ImGui::PopID();
    ImGui::TableNextColumn();
    right_aligned(fmt::format(
        "{:.0f} %", 100 * static_cast<double>(place.bad) / static_cast<double>(place.tets)));
    ImGui::TableNextColumn();
    right_aligned(fmt::format("{:.4f}", place.q_worst));
  }
  ImGui::EndTable();
}

}  // namespace tetmend::viewer::ui
