// SPDX-License-Identifier: MIT
// The shell of the call at hand: its polygon drawn flat, its tets before and after.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "explain/figures/ring_drawing.h"
#include "viewer/ui/drawing_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/slider.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

/// The polygon as it is at the place in the trace.
void show_polygon(Document& document, const PolygonView& polygon, float side) {
  const Square square = square_at_cursor(side);
  const double font = ImGui::GetFontSize();
  RingLook look;
  look.middle = square.middle;
  look.half = square.half;
  // Of a small polygon, small ones: they must not cover it.
  look.name_size = std::min(font, 0.085 * double{side});
  look.number_size = std::min(0.85 * font, 0.065 * double{side});
  look.line = font / 16;
  look.ink = colour_of(ImGuiCol_Text);
  look.patch = colour_of(ImGuiCol_WindowBg);
  look.patch.alpha = 190;
  look.map = &find_colour_map(document.view.scene.map);
  show_linked("##polygon", draw_polygon(polygon, look), side, document);
}

void show_blended(Document& document, std::span<const LinkedDrawing> drawings, float side) {
  constexpr double kLow = 0;
  constexpr double kHigh = 1;
  ViewSettings& view = document.view;
  show_linked("##blended", drawings, side, document);
  ImGui::SetNextItemWidth(side);
  slider("##blend", ImGuiDataType_Double, &view.blend, &kLow, &kHigh, "after %.2f");
}

/// A row of a table, which stands for vertices.
void point_at_row(Document& document, const std::string& name, std::vector<VertexHandle> vertices) {
  ImGui::Selectable(name.c_str(), document.pointed().contains(vertices),
                    ImGuiSelectableFlags_SpanAllColumns);
  if (ImGui::IsItemHovered()) document.hovering = {std::move(vertices)};
}

/// Chords of the polygon with their pockets, as they were before the edit; best first.
void list_chords(Document& document, const ShellPicture& shell) {
  ImGui::SetNextItemOpen(true, ImGuiCond_Once);
  if (!ImGui::TreeNodeEx("chords and their pockets", ImGuiTreeNodeFlags_NoTreePushOnOpen)) return;
  const std::vector<Chord> chords = chords_of(shell);
  if (shell.pockets.empty()) return ImGui::TextDisabled("too many corners to be searched");
  if (shell.locks.any()) wrapped_text(locks_text(shell));
  if (chords.empty()) return ImGui::TextDisabled("no chord has a pocket");
  constexpr ImGuiTableFlags kLooks = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
  if (!ImGui::BeginTable("##chords", 3, kLooks,
                         {0, kChordRows * ImGui::GetTextLineHeightWithSpacing()}))
    return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("chord, best first");
  ImGui::TableSetupColumn("worst q, one side");
  ImGui::TableSetupColumn("other side");
  ImGui::TableHeadersRow();
  const auto quality = [&](const PocketRanking& pocket) {
    const auto worst = static_cast<double>(pocket[0]);
    ImGui::TableNextColumn();
    if (worst <= 0) return ImGui::TextDisabled("none");
    if (pocket[0] > shell.floor) return ImGui::Text("%.4f, better", worst);
    ImGui::TextDisabled("%.4f", worst);
  };
  for (const Chord& chord : chords) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string name =
        fmt::format("{} - {}", shell.ring[chord.from].index(), shell.ring[chord.to].index());
    point_at_row(document, name, {shell.ring[chord.from], shell.ring[chord.to]});
    quality(chord.on);
    quality(chord.back);
  }
  ImGui::EndTable();
}

/// Beside the ring, both pictures are as high as that with what stands below it.
float side_beside_ring(float width) {
  constexpr float kMost = 0.35F;
  const float high = kRingShare * width + ImGui::GetFrameHeightWithSpacing() -
                     2 * ImGui::GetTextLineHeightWithSpacing() - ImGui::GetStyle().ItemSpacing.y;
  return std::min(kMost * width, high / 2);
}

/// All in the same ball, so that one can be laid over the other; seen as in the large picture.
/// `right`: where the later ones begin, beside the earlier ones; 0: below.
void show_tets(Document& document, const CallStudy& study, float side, float right = 0) {
  const auto ball = ball_around(study);
  if (!ball) return;
  ViewSettings& view = document.view;
  const ColourMap& map = find_colour_map(view.scene.map);
  const auto draw = [&](const std::vector<LocalTet>& tets, double opacity) {
    return draw_tets(tets, view.camera, *ball, square_at_cursor(side), map, opacity);
  };
  constexpr double kOpacity = 0.9;
  const char* name = study.undone ? "tried" : "after";
  if (view.blended) {
    ImGui::Text("%zu tets, %s %zu", study.before.size(), name, study.after.size());
    const std::array drawings = {draw(study.before, kOpacity * (1 - view.blend)),
                                 draw(study.after, kOpacity * view.blend)};
    return show_blended(document, drawings, side);
  }
  ImGui::BeginGroup();
  ImGui::Text("before: %zu tets", study.before.size());
  show_linked("##before", draw(study.before, kOpacity), side, document);
  ImGui::EndGroup();
  if (right > 0) ImGui::SameLine(right);
  ImGui::BeginGroup();
  if (study.after.empty()) {
    ImGui::TextDisabled("nothing was tried");
  } else {
    ImGui::Text("%s: %zu tets", name, study.after.size());
    show_linked("##after", draw(study.after, kOpacity), side, document);
  }
  ImGui::EndGroup();
}

}  // namespace

void draw_shell_panel(Session& session) {
  Document& document = session.document;
  const CallStudy* study = document.debugger()->study();
  if (study == nullptr) return;
  const float width = ImGui::GetContentRegionAvail().x;
  std::optional<PolygonView> polygon;
  if (study->picture) polygon = document.debugger()->polygon();
  const bool has_polygon = polygon && polygon->shell->ring.size() >= 3;
  if (has_polygon) {
    wrapped_text(polygon->caption);
    ImGui::BeginGroup();
    show_polygon(document, *polygon, kRingShare * width);
    ImGui::Checkbox("blended", &document.view.blended);
    ImGui::EndGroup();
    ImGui::SameLine(0.64F * width);
  }
  if (!has_polygon) return show_tets(document, *study, 0.45F * width, 0.5F * width);
  ImGui::BeginGroup();
  show_tets(document, *study, side_beside_ring(width));
  ImGui::EndGroup();
  list_chords(document, *polygon->shell);
  draw_tables_fold(session);
}

namespace {

float paragraph_height(const std::string& paragraph, float width) {
  const std::string lines = in_lines(paragraph, width);
  const auto breaks = static_cast<float>(std::count(lines.begin(), lines.end(), '\n'));
  return (breaks + 1) * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
}

/// Words above the ring, as far as they leave it nearly as large as it would be without.
void tell_ring(Session& session, const std::string& caption) {
  constexpr float kNearly = 0.85F;
  constexpr std::size_t kMostCalls = 2;
  constexpr float kStackLines = 4;  // with the calls around, and what is to be removed
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float most = std::min(room.x, room.y);
  const float words = paragraph_height(caption, room.x);
  const float stack = kStackLines * ImGui::GetTextLineHeightWithSpacing();
  const auto leaves = [&](float height) {
    return std::min(room.x, room.y - height) >= kNearly * most;
  };
  if (leaves(words + stack)) draw_stack(session, kMostCalls);
  if (leaves(words)) wrapped_text(caption);
}

}  // namespace

void draw_ring(Session& session, bool is_told) {
  Document& document = session.document;
  const CallStudy* study = document.debugger()->study();
  if (study == nullptr) return;
  if (!study->picture || study->picture->ring.size() < 3) {
    return show_tets(document, *study, 0.45F * ImGui::GetContentRegionAvail().y);
  }
  const PolygonView polygon = document.debugger()->polygon();
  if (is_told) tell_ring(session, polygon.caption);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float side = std::max(std::min(room.x, room.y), 6 * ImGui::GetFontSize());
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + (room.x - side) / 2);
  show_polygon(document, polygon, side);
}

}  // namespace tetmend::viewer::ui
