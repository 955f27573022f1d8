// SPDX-License-Identifier: MIT
// The tables M_q and M_k of Algorithm 2, cell by cell while they are being filled.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/ui/drawing_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

struct Tables {
  const ShellPicture& shell;
  TableFilling filling;
  std::set<std::pair<unsigned, unsigned>> used = {};  // by the cell that was filled last

  const PocketTables& entries() const { return shell.tables; }
  unsigned size() const { return static_cast<unsigned>(entries().size); }
};

Tables tables_of(Debugger& debugger, const ShellPicture& shell) {
  Tables tables{shell, debugger.tables()};
  if (const auto here = tables.filling.here()) {
    for (const CellChoice& choice : choices_of(shell.tables, *here)) {
      tables.used.insert({here->i, choice.k});
      tables.used.insert({choice.k, here->j});
    }
  }
  return tables;
}

/// In the middle of the cell; `is_better` in bold, and green.
void cell_text(const std::string& text, ImVec2 at, float room, ImU32 colour, bool is_better) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  at.x += std::max(0.0F, (room - ImGui::CalcTextSize(text.c_str()).x) / 2);
  list->AddText(at, colour, text.c_str());
  // Twice, a pixel apart at least: less is lost where text is set on whole pixels.
  const float apart = std::max(1.0F, std::round(ImGui::GetFontSize() / 24));
  if (is_better) list->AddText({at.x + apart, at.y}, colour, text.c_str());
}

ImU32 better_colour() {
  constexpr int kLight = 128;
  const bool is_dark = colour_of(ImGuiCol_Text).green > kLight;
  return is_dark ? IM_COL32(70, 215, 195, 255) : IM_COL32(0, 112, 100, 255);
}

std::string entry_text(const Tables& tables, unsigned i, unsigned j, bool is_quality) {
  const bool is_side = j == (i + 1) % tables.size();
  const unsigned k = tables.entries().k(i, j);
  if (is_quality && is_side) return infinity_text();
  if (k >= tables.size()) return is_quality ? "none" : "-";
  if (is_quality) return fmt::format("{:.3f}", tables.entries().q(i, j));
  return fmt::format("{}", tables.shell.ring[k].index());
}

void paint_cell(const Tables& tables, unsigned i, unsigned j) {
  Colour light = kCellColour;
  light.alpha = 60;
  if (tables.used.contains({i, j})) {
    ImGui::TableSetBgColor(ImGuiTableBgTarget_CellBg, to_imgui(light));
  }
}

void frame_cell(const ImVec2& at, float room) {
  const ImVec2 pad = ImGui::GetStyle().CellPadding;
  ImGui::GetWindowDrawList()->AddRect(
      {at.x - pad.x, at.y - pad.y},
      {at.x + room + pad.x, at.y + ImGui::GetTextLineHeight() + pad.y}, to_imgui(kCellColour), 0, 0,
      std::max(2.0F, ImGui::GetFontSize() / 8));
}

/// The mouse on it points at the triangle that it has chosen.
void show_cell(Document& document, const Tables& tables, unsigned i, unsigned j, bool is_quality) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float room = ImGui::GetContentRegionAvail().x;
  if (i == j) return cell_text(".", at, room, ImGui::GetColorU32(ImGuiCol_TextDisabled), false);
  const bool is_side = j == (i + 1) % tables.size();
  if (!is_side && !tables.filling.is_filled(i, j)) {
    return ImGui::TableSetBgColor(ImGuiTableBgTarget_CellBg,
                                  ImGui::GetColorU32(ImGuiCol_FrameBg, 0.6F));
  }
  paint_cell(tables, i, j);
  const unsigned k = tables.entries().k(i, j);
  const bool is_there = k < tables.size();
  if (is_there) {
    const auto& ring = tables.shell.ring;
    std::vector<VertexHandle> triangle = {ring[i], ring[k], ring[j]};
    ImGui::PushID(static_cast<int>(i * tables.size() + j));
    ImGui::Selectable("##cell", document.pointed().contains(triangle), 0,
                      {0, ImGui::GetTextLineHeight()});
    if (ImGui::IsItemHovered()) document.hovering = {std::move(triangle)};
    ImGui::PopID();
  }
  const bool is_better = is_quality && is_there && tables.entries().q(i, j) > tables.shell.floor;
  const ImU32 ink = ImGui::GetColorU32(is_there ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  cell_text(entry_text(tables, i, j, is_quality), at, room, is_better ? better_colour() : ink,
            is_better);
  const auto here = tables.filling.here();
  if (here && here->i == i && here->j == j) frame_cell(at, room);
}

/// Rows and columns are vertices of the ring; a cell is the pocket from its row on to its column.
void show_table(Document& document, const Tables& tables, bool is_quality) {
  const unsigned m = tables.size();
  const auto head = [&](unsigned i) {
    ImGui::TableNextColumn();
    cell_text(fmt::format("{}", tables.shell.ring[i].index()), ImGui::GetCursorScreenPos(),
              ImGui::GetContentRegionAvail().x, ImGui::GetColorU32(ImGuiCol_TextDisabled), false);
    ImGui::Dummy({0, ImGui::GetTextLineHeight()});
  };
  indexed_text(is_quality ? "M_q: quality of the pocket" : "M_k: its third corner");
  constexpr ImGuiTableFlags kLooks = ImGuiTableFlags_Borders | ImGuiTableFlags_SizingStretchSame;
  if (!ImGui::BeginTable(is_quality ? "##q" : "##k", static_cast<int>(m) + 1, kLooks)) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("i \\ j");
  for (unsigned j = 0; j < m; ++j) head(j);
  for (unsigned i = 0; i < m; ++i) {
    ImGui::TableNextRow();
    head(i);
    for (unsigned j = 0; j < m; ++j) {
      ImGui::TableNextColumn();
      show_cell(document, tables, i, j, is_quality);
    }
  }
  ImGui::EndTable();
}

/// The text of the last cell is about the longest: room for it keeps the tables where they are.
float lines_of_text(const Tables& tables, float width) {
  TableFilling last = tables.filling;
  last.filled = last.cells.size();
  const std::string text = in_lines(to_text(tables.shell, last), width);
  return 1 + static_cast<float>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

void draw_tables_fold(Session& session) {
  Debugger& debugger = *session.document.debugger();
  const ShellPicture& shell = *debugger.polygon().shell;
  if (shell.tables.size == 0) return;
  ImGui::SetNextItemOpen(debugger.shows_tables);
  const bool is_open = ImGui::TreeNodeEx("##tables", ImGuiTreeNodeFlags_NoTreePushOnOpen);
  if (is_open != debugger.shows_tables) run_from_window(find_command("tables"), session);
  ImGui::SameLine(ImGui::GetCursorStartPos().x + ImGui::GetTreeNodeToLabelSpacing());
  indexed_text("tables M_q and M_k (Algorithm 2)");
  if (!is_open) return;
  const Tables tables = tables_of(debugger, shell);
  wrapped_text(to_text(shell, tables.filling));
  show_table(session.document, tables, true);
  show_table(session.document, tables, false);
}

namespace {

/// Of the two tables: beside or below each other, and how much smaller the text must be.
struct Arrangement {
  bool is_beside = true;
  float share = 1;
};

Arrangement arrange_tables(const Tables& tables, const ImVec2& room) {
  constexpr float kHead = 2.5F;    // caption, head and gaps, in rows
  constexpr float kColumn = 3.1F;  // in sizes of the text
  const auto m = static_cast<float>(tables.size());
  const float row = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
  const float text = lines_of_text(tables, room.x);
  const float column = (m + 1) * kColumn * ImGui::GetFontSize();
  const auto share = [&](float down, float across) {
    return std::min(room.y / ((down * (m + kHead) + text) * row), room.x / (across * column));
  };
  const float beside = share(1, 2);
  const float below = share(2, 1);
  return {beside >= below, std::min(1.0F, std::max(beside, below))};
}

}  // namespace

void draw_tables(Session& session) {
  constexpr float kLeast = 0.5F;
  Debugger& debugger = *session.document.debugger();
  const CallStudy* study = debugger.study();
  if (study == nullptr || !study->picture) return;
  const ShellPicture& shell = *debugger.polygon().shell;
  if (shell.tables.size == 0) return ImGui::TextDisabled("no tables were filled in");
  const Tables tables = tables_of(debugger, shell);
  ImGui::SetWindowFontScale(1);
  const Arrangement made = arrange_tables(tables, ImGui::GetContentRegionAvail());
  ImGui::SetWindowFontScale(std::max(kLeast, made.share));
  if (!ImGui::BeginTable("##both", made.is_beside ? 2 : 1)) return;
  for (const bool is_quality : {true, false}) {
    ImGui::TableNextColumn();
    show_table(session.document, tables, is_quality);
  }
  ImGui::EndTable();
  wrapped_text(to_text(shell, tables.filling));
}

}  // namespace tetmend::viewer::ui
