// SPDX-License-Identifier: MIT
// The shell of the call at hand: its polygon drawn flat, its tets before and after.
#include <array>

#include "viewer/ui/flat_canvas.h"
#include "viewer/ui/panels.h"

namespace tetmend::viewer::ui {

namespace {

bool is_refused(const Debugger& debugger) {
  const Call& call = debugger.file().calls()[debugger.call()];
  return !call.accepted && debugger.position() >= call.events.end;
}

void show_polygon(const Document& document, const CallStudy& study, float side) {
  const Debugger& debugger = *document.debugger();
  const ColourMap& map = find_colour_map(document.view.scene.map);
  const FlatDrawing drawing = draw_polygon(study, debugger.position(), is_refused(debugger), map);
  ImGui::TextWrapped("%s", drawing.caption.c_str());
  const float indent = (ImGui::GetContentRegionAvail().x - side) / 2;
  if (indent > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent);
  show_flat("##polygon", drawing, side);
}

/// Both in the same ball, so that one can be laid over the other.
void show_tets(Document& document, const CallStudy& study) {
  const auto ball = ball_around(study);
  if (!ball) return;
  ViewSettings& view = document.view;
  const ColourMap& map = find_colour_map(view.scene.map);
  const float width = ImGui::GetContentRegionAvail().x;
  const float side =
      std::min(width / 2 - ImGui::GetStyle().ItemSpacing.x, 11 * ImGui::GetFontSize());
  const auto draw = [&](const std::vector<LocalTet>& tets, double opacity) {
    return draw_tets(tets, view.camera, *ball, map, opacity);
  };
  ImGui::Checkbox("blended", &view.blended);
  if (view.blended) {
    ImGui::SameLine();
    const double low = 0;
    const double high = 1;
    ImGui::SetNextItemWidth(-1);
    ImGui::SliderScalar("##blend", ImGuiDataType_Double, &view.blend, &low, &high, "after: %.2f");
    const std::array drawings = {draw(study.before, 1 - view.blend), draw(study.after, view.blend)};
    return show_flat("##blended", drawings, side);
  }
  ImGui::SameLine();
  ImGui::TextDisabled("seen as in the picture");
  ImGui::BeginGroup();
  ImGui::Text("before: %zu tets", study.before.size());
  show_flat("##before", draw(study.before, 0.9), side);
  ImGui::EndGroup();
  ImGui::SameLine(width / 2);
  ImGui::BeginGroup();
  if (study.after.empty()) {
    ImGui::TextDisabled("nothing was tried");
  } else {
    ImGui::Text("%s: %zu tets", study.undone ? "tried" : "after", study.after.size());
    show_flat("##after", draw(study.after, 0.9), side);
  }
  ImGui::EndGroup();
}

}  // namespace

void draw_shell_panel(Session& session) {
  Document& document = session.document;
  const CallStudy* study = document.debugger()->study();
  if (study == nullptr) {
    ImGui::TextDisabled("no call here");
    return;
  }
  const float side = std::min(ImGui::GetContentRegionAvail().x, 19 * ImGui::GetFontSize());
  if (study->picture && study->picture->ring.size() >= 3) show_polygon(document, *study, side);
  show_tets(document, *study);
}

}  // namespace tetmend::viewer::ui
