// SPDX-License-Identifier: MIT
// What is known of the picked tet, edge or vertex, with a legend of the colours of a shell.
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include <imgui.h>

#include "kernel/spaced.h"
#include "viewer/ui/call_row.h"
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

/// True if it was clicked.
bool show_link(Document& document, const std::string& text, const Selection& link) {
  const Pointed what = document.pointed_selection(link);
  const bool is_lit = document.pointed().vertices == what.vertices;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const bool is_clicked = ImGui::Selectable(text.c_str(), is_lit, 0, size);
  ImGui::PopStyleColor();
  if (ImGui::IsItemHovered()) document.hovering = what;
  return is_clicked;
}

/// The value of a row, with a link for the whole of it or for each word. Gives the one clicked.
std::optional<Selection> show_value(Document& document, const Row& row) {
  if (row.links.empty()) {
    ImGui::TextWrapped("%s", row.value.c_str());
    return std::nullopt;
  }
  std::optional<Selection> clicked;
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  std::string_view rest = row.value;
  for (std::size_t i = 0; i < row.links.size(); ++i) {
    const std::string word(row.links.size() == 1 ? rest : rest.substr(0, rest.find(' ')));
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    const float width = ImGui::CalcTextSize(word.c_str()).x;
    const float gap = 0.5F * ImGui::GetFontSize();
    if (i > 0 && ImGui::GetItemRectMax().x + gap + width < right) ImGui::SameLine(0, gap);
    ImGui::PushID(static_cast<int>(i));
    if (show_link(document, word, row.links[i])) clicked = row.links[i];
    ImGui::PopID();
  }
  return clicked;
}

std::optional<Selection> show_rows(Document& document, const std::vector<Row>& rows) {
  std::optional<Selection> clicked;
  if (!ImGui::BeginTable("##selection", 2, ImGuiTableFlags_RowBg)) return clicked;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 9 * ImGui::GetFontSize());
  for (const Row& row : rows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", spaced(row.name).c_str());
    ImGui::TableNextColumn();
    ImGui::PushID(row.name.c_str());
    if (const auto link = show_value(document, row)) clicked = link;
    ImGui::PopID();
  }
  ImGui::EndTable();
  return clicked;
}

}  // namespace

void draw_selection_panel(Session& session) {
  Document& document = session.document;
  if (ImGui::Button("go to ...")) run_from_window(find_command("go_to"), session);
  if (!std::holds_alternative<std::monostate>(document.selection())) {
    ImGui::SameLine();
    ImGui::Checkbox("alone", &document.view.scene.isolate);
  }
  const std::vector<Row> rows = describe(document.mesh(), document.selection());
  if (rows.empty()) {
    ImGui::TextDisabled("click a tet, an edge or a vertex");
    return;
  }
  const auto clicked = show_rows(document, rows);
  if (std::holds_alternative<TetEdge>(document.selection())) {
    legend("supporting edge", kSupportingEdgeColour);
    legend("skirt polygon", kSkirtColour);
    legend("outlines of supporting faces and link faces", kLinkEdgeColour);
  }
  if (clicked) guarded(document, [&] { document.fly_to(*clicked); });
}

}  // namespace tetmend::viewer::ui
