// SPDX-License-Identifier: MIT
// The shell of the call at hand: its polygon drawn flat, its tets before and after.
#include <array>

#include "viewer/ui/flat_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

bool is_refused(const Debugger& debugger) {
  const Call& call = debugger.file().calls()[debugger.call()];
  return !call.accepted() && debugger.position() >= call.events.end;
}

void show_blended(ViewSettings& view, std::span<const FlatDrawing> drawings, float side) {
  constexpr double kLow = 0;
  constexpr double kHigh = 1;
  show_flat("##blended", drawings, side);
  ImGui::SetNextItemWidth(side);
  ImGui::SliderScalar("##blend", ImGuiDataType_Double, &view.blend, &kLow, &kHigh, "after %.2f");
}

/// Chords of the polygon with their pockets, as they were before the edit; best first.
void list_chords(const ShellPicture& shell) {
  ImGui::SetNextItemOpen(true, ImGuiCond_Once);
  if (!ImGui::TreeNodeEx("chords and their pockets", ImGuiTreeNodeFlags_NoTreePushOnOpen)) return;
  const std::vector<Chord> chords = chords_of(shell);
  if (shell.pockets.empty()) return ImGui::TextDisabled("too many corners to be searched");
  if (shell.locks.any()) wrapped_text(locks_text(shell));
  if (chords.empty()) return ImGui::TextDisabled("no chord has a pocket");
  constexpr float kRows = 5.2F;  // with the head; more can be scrolled to
  constexpr ImGuiTableFlags kLooks = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
  if (!ImGui::BeginTable("##chords", 3, kLooks, {0, kRows * ImGui::GetTextLineHeightWithSpacing()}))
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
    ImGui::Text("%u - %u", shell.ring[chord.from].index(), shell.ring[chord.to].index());
    quality(chord.on);
    quality(chord.back);
  }
  ImGui::EndTable();
}

/// All in the same ball, so that one can be laid over the other; seen as in the large picture.
void show_tets(Document& document, const CallStudy& study, float side) {
  const auto ball = ball_around(study);
  if (!ball) return;
  ViewSettings& view = document.view;
  const ColourMap& map = find_colour_map(view.scene.map);
  const auto draw = [&](const std::vector<LocalTet>& tets, double opacity) {
    return draw_tets(tets, view.camera, *ball, map, opacity);
  };
  constexpr double kOpacity = 0.9;
  const char* name = study.undone ? "tried" : "after";
  if (view.blended) {
    ImGui::Text("%zu tets, %s %zu", study.before.size(), name, study.after.size());
    const std::array drawings = {draw(study.before, kOpacity * (1 - view.blend)),
                                 draw(study.after, kOpacity * view.blend)};
    return show_blended(view, drawings, side);
  }
  ImGui::Text("before: %zu tets", study.before.size());
  show_flat("##before", draw(study.before, kOpacity), side);
  if (study.after.empty()) {
    ImGui::TextDisabled("nothing was tried");
  } else {
    ImGui::Text("%s: %zu tets", name, study.after.size());
    show_flat("##after", draw(study.after, kOpacity), side);
  }
}

}  // namespace

void draw_shell_panel(Session& session) {
  Document& document = session.document;
  const CallStudy* study = document.debugger()->study();
  if (study == nullptr) {
    ImGui::TextDisabled("no call here");
    return;
  }
  const float width = ImGui::GetContentRegionAvail().x;
  const bool has_polygon = study->picture && study->picture->ring.size() >= 3;
  if (has_polygon) {
    const Debugger& debugger = *document.debugger();
    const FlatDrawing drawing = draw_polygon(*study, debugger.position(), is_refused(debugger),
                                             find_colour_map(document.view.scene.map));
    wrapped_text(drawing.caption);
    ImGui::BeginGroup();
    show_flat("##polygon", drawing, 0.6F * width);
    ImGui::Checkbox("blended", &document.view.blended);
    ImGui::EndGroup();
    ImGui::SameLine(0.64F * width);
  }
  ImGui::BeginGroup();
  show_tets(document, *study, 0.35F * width);
  ImGui::EndGroup();
  if (has_polygon) list_chords(*study->picture);
}

}  // namespace tetmend::viewer::ui
