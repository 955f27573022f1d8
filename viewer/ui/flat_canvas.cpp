// SPDX-License-Identifier: MIT
#include "viewer/ui/flat_canvas.h"

#include <cmath>

namespace tetmend::viewer::ui {

namespace {

class Pen {
 public:
  Pen(ImVec2 corner, float side, const Pointed& pointed)
      : middle_(corner.x + side / 2, corner.y + side / 2), half_(side / 2), pointed_(pointed) {}

  void draw(const FlatDrawing& drawing) const {
    for (const auto& area : drawing.areas) fill(area);
    for (const auto& stroke : drawing.strokes) line(stroke);
    for (const auto& label : drawing.labels) write(label);
  }

  /// What the mouse is on: a name, else a stroke, else an area; its vertices.
  std::vector<VertexHandle> named_under_mouse(const FlatDrawing& drawing) const {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float reach = 0.8F * ImGui::GetFontSize();
    for (const auto& label : drawing.labels) {
      const ImVec2 at = to_pixel(label.at);
      const bool is_near = std::hypot(at.x - mouse.x, at.y - mouse.y) < reach;
      if (is_near && !label.vertices.empty()) return label.vertices;
    }
    if (const auto* stroke = under_mouse(drawing)) return stroke->vertices;
    for (auto area = drawing.areas.rbegin(); area != drawing.areas.rend(); ++area) {
      if (!area->vertices.empty() && is_inside(*area, mouse)) return area->vertices;
    }
    return {};
  }

  /// The stroke that the mouse is on.
  const FlatDrawing::Stroke* under_mouse(const FlatDrawing& drawing) const {
    constexpr float kReach = 5;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    for (const auto& stroke : drawing.strokes) {
      if (stroke.tip.empty() && stroke.vertices.size() != 2) continue;
      const ImVec2 a = to_pixel(stroke.from);
      const ImVec2 b = to_pixel(stroke.to);
      const float dx = b.x - a.x;
      const float dy = b.y - a.y;
      const float length2 = std::max(dx * dx + dy * dy, 1.0F);
      const float t = ((mouse.x - a.x) * dx + (mouse.y - a.y) * dy) / length2;
      const float away = std::abs((mouse.x - a.x) * dy - (mouse.y - a.y) * dx) / std::sqrt(length2);
      if (t > 0.05F && t < 0.95F && away < kReach) return &stroke;
    }
    return nullptr;
  }

 private:
  ImVec2 to_pixel(const glm::dvec2& p) const {
    return {middle_.x + half_ * static_cast<float>(p.x),
            middle_.y - half_ * static_cast<float>(p.y)};
  }

  void fill(const FlatDrawing::Area& area) const {
    std::vector<ImVec2> corners;
    for (const glm::dvec2& p : area.corners) corners.push_back(to_pixel(p));
    list_->AddConvexPolyFilled(corners.data(), static_cast<int>(corners.size()),
                               to_imgui(area.colour));
    if (!pointed_.contains(area.vertices)) return;
    Colour light = kPointedColour;
    light.alpha = 90;
    list_->AddConvexPolyFilled(corners.data(), static_cast<int>(corners.size()), to_imgui(light));
  }

  void line(const FlatDrawing::Stroke& stroke) const {
    const ImVec2 a = to_pixel(stroke.from);
    const ImVec2 b = to_pixel(stroke.to);
    const float width = static_cast<float>(stroke.width) * ImGui::GetFontSize() / 16;
    if (stroke.vertices.size() == 2 && pointed_.contains(stroke.vertices)) {
      list_->AddLine(a, b, to_imgui(kPointedColour), 2 * width + 4);
    }
    if (!stroke.dashed) return list_->AddLine(a, b, to_imgui(stroke.colour), width);
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    const float dash = 0.4F * ImGui::GetFontSize();
    for (float at = 0; at < length; at += 2 * dash) {
      const float s = at / length;
      const float t = std::min(at + dash, length) / length;
      list_->AddLine({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)},
                     {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}, to_imgui(stroke.colour),
                     width);
    }
  }

  /// On a patch of the background, so that it can be read on any colour.
  void write(const FlatDrawing::Label& label) const {
    const ImVec2 size = ImGui::CalcTextSize(label.text.c_str());
    const ImVec2 at = to_pixel(label.at);
    const ImVec2 corner = {at.x - size.x / 2, at.y - size.y / 2};
    ImVec4 patch = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
    patch.w = label.strong ? 0.0F : 0.75F;
    if (pointed_.contains(label.vertices)) {
      list_->AddCircleFilled(at, 0.8F * ImGui::GetFontSize(), to_imgui(kPointedColour));
    }
    list_->AddRectFilled({corner.x - 2, corner.y}, {corner.x + size.x + 2, corner.y + size.y},
                         ImGui::GetColorU32(patch), 3);
    list_->AddText(corner, ImGui::GetColorU32(ImGuiCol_Text), label.text.c_str());
  }

  bool is_inside(const FlatDrawing::Area& area, ImVec2 mouse) const {
    bool left = false;
    bool right = false;
    for (std::size_t i = 0; i < area.corners.size(); ++i) {
      const ImVec2 a = to_pixel(area.corners[i]);
      const ImVec2 b = to_pixel(area.corners[(i + 1) % area.corners.size()]);
      const float side = (b.x - a.x) * (mouse.y - a.y) - (b.y - a.y) * (mouse.x - a.x);
      (side < 0 ? left : right) = true;
    }
    return left != right;
  }

  ImVec2 middle_;
  float half_;
  const Pointed& pointed_;
  ImDrawList* list_ = ImGui::GetWindowDrawList();
};

}  // namespace

void show_flat(const char* id, std::span<const FlatDrawing> drawings, float side,
               Document& document) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(id, {side, side});
  const bool is_hovered = ImGui::IsItemHovered();
  const Pen pen(corner, side, document.pointed());
  for (const FlatDrawing& drawing : drawings) {
    pen.draw(drawing);
    if (!is_hovered) continue;
    const auto* stroke = pen.under_mouse(drawing);
    if (stroke != nullptr && !stroke->tip.empty()) ImGui::SetTooltip("%s", stroke->tip.c_str());
    auto vertices = pen.named_under_mouse(drawing);
    if (!vertices.empty()) document.hovering = {std::move(vertices)};
  }
}

void show_flat(const char* id, const FlatDrawing& drawing, float side, Document& document) {
  show_flat(id, {&drawing, 1}, side, document);
}

}  // namespace tetmend::viewer::ui
