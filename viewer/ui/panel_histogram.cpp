// SPDX-License-Identifier: MIT
// Histogram in the colours of the map; dragging over it filters.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "figure/drawing.h"
#include "kernel/grouped.h"
#include "kernel/spaced.h"
#include "viewer/mesh/tet_values.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/drawing_canvas.h"
#include "viewer/ui/panels.h"

namespace tetmend::viewer::ui {

namespace {

void choose_measure(SceneSettings& scene) {
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##measure", spaced(scene.measure).c_str())) return;
  for (const TetValue& value : tet_values()) {
    if (ImGui::Selectable(spaced(value.name).c_str(), scene.measure == value.name)) {
      const bool follow = scene.colour == scene.measure;
      scene.measure = value.name;
      scene.filtered = false;
      if (follow) scene.colour = value.name;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", value.help.data());
  }
  ImGui::EndCombo();
}

void draw_bars(const Histogram& histogram, const SceneSettings& scene, ImVec2 corner, ImVec2 size) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ColourMap& map = find_colour_map(scene.map);
  const float width = size.x / static_cast<float>(Histogram::kBins);
  const float bottom = corner.y + size.y;
  list->AddRectFilled(corner, {corner.x + size.x, bottom}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  for (std::size_t i = 0; i < Histogram::kBins; ++i) {
    const double middle = (static_cast<double>(i) + 0.5) / static_cast<double>(Histogram::kBins);
    const Range bin = histogram.bin(i);
    Colour colour = map.at(middle);
    const bool is_in = scene.range.contains((bin.low + bin.high) / 2);
    if (scene.filtered && is_in == scene.outside) colour.alpha = 70;
    const float left = corner.x + width * static_cast<float>(i);
    const auto height = static_cast<float>(histogram.bar(i)) * (size.y - 4);
    list->AddRectFilled({left, bottom - height}, {left + width + 0.5F, bottom}, to_imgui(colour));
  }
}

void draw_brush(const Histogram& histogram, const SceneSettings& scene, ImVec2 corner,
                ImVec2 size) {
  if (!scene.filtered) return;
  const Range& all = histogram.range();
  const auto place = [&](double value) {
    const double t = std::clamp((value - all.low) / (all.high - all.low), 0.0, 1.0);
    return corner.x + size.x * static_cast<float>(t);
  };
  ImGui::GetWindowDrawList()->AddRect({place(scene.range.low), corner.y},
                                      {place(scene.range.high), corner.y + size.y},
                                      ImGui::GetColorU32(ImGuiCol_Text), 0, 0, 1.5F);
}

/// Ticks below the bars; of the quality, a line where the goal is just met.
void draw_axis(const Histogram& histogram, const std::string& measure, ImVec2 corner, ImVec2 size) {
  constexpr unsigned kTicks = 5;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const Range& range = histogram.range();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  const float bottom = corner.y + size.y;
  const auto place = [&](double value) {
    return corner.x + size.x * static_cast<float>((value - range.low) / (range.high - range.low));
  };
  const auto tick = [&](double value, const std::string& text) {
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    const float x = place(value);
    const float left = std::clamp(x - width / 2, corner.x, corner.x + size.x - width);
    list->AddLine({x, bottom}, {x, bottom + 4}, ink);
    list->AddText({left, bottom + 4}, ink, text.c_str());
  };
  for (const double value : figure::ticks(range.low, range.high, kTicks)) {
    tick(value, figure::tick_text(value));
  }
  ImGui::Dummy({size.x, ImGui::GetTextLineHeight() + 2});
  if (find_tet_value(measure).measure != nullptr) return;
  constexpr double kGoal = 1;  // of the quality that the mesh stores
  const float x = place(kGoal);
  list->AddLine({x, corner.y}, {x, bottom}, ink, 1.5F);
  list->AddText({x + 4, corner.y + 1}, ink, "goal");
}

void follow_mouse(const Histogram& histogram, SceneSettings& scene, float left, float width) {
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0, 2)) {
    const double from = (ImGui::GetIO().MouseClickedPos[0].x - left) / width;
    const double to = (ImGui::GetIO().MousePos.x - left) / width;
    scene.range = histogram.brushed(from, to);
    scene.filtered = true;
  } else if (ImGui::IsItemDeactivated() && !ImGui::IsMouseDragging(0, 2)) {
    const ImVec2 moved = ImGui::GetMouseDragDelta(0, 2);
    if (moved.x == 0 && moved.y == 0) scene.filtered = false;
  }
}

void explain_bin(const Histogram& histogram, float left, float width) {
  if (!ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
  const float t = std::clamp((ImGui::GetIO().MousePos.x - left) / width, 0.0F, 0.9999F);
  const auto i = static_cast<std::size_t>(t * static_cast<float>(Histogram::kBins));
  const Range bin = histogram.bin(i);
  ImGui::SetTooltip("%.3g to %.3g: %zu tets\ndrag to filter, click for all", bin.low, bin.high,
                    histogram.counts()[i]);
}

}  // namespace

void draw_histogram_panel(Session& session) {
  Document& document = session.document;
  SceneSettings& scene = document.view.scene;
  choose_measure(scene);
  const Histogram& histogram = document.histogram();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size = {ImGui::GetContentRegionAvail().x, 7 * ImGui::GetFontSize()};
  ImGui::InvisibleButton("##histogram", size);
  follow_mouse(histogram, scene, corner.x, size.x);
  draw_bars(histogram, scene, corner, size);
  draw_brush(histogram, scene, corner, size);
  explain_bin(histogram, corner.x, size.x);

  draw_axis(histogram, scene.measure, corner, size);
  ImGui::TextDisabled("height: tets, logarithmic; most %s", grouped(histogram.largest()).c_str());
  ImGui::Checkbox("filter", &scene.filtered);
  ImGui::SameLine();
  ImGui::Checkbox("outside", &scene.outside);
  if (scene.filtered) {
    ImGui::SameLine();
    const Range& all = histogram.range();
    ImGui::Text("%.3g - %.3g", std::max(scene.range.low, all.low),
                std::min(scene.range.high, all.high));
  }
}

}  // namespace tetmend::viewer::ui
