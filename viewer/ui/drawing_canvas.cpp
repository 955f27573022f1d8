// SPDX-License-Identifier: MIT
#include "viewer/ui/drawing_canvas.h"

#include <cmath>
#include <vector>

namespace tetmend::viewer::ui {

namespace {

ImVec2 to_imgui(const figure::Place& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

class CanvasPainter {
 public:
  explicit CanvasPainter(ImDrawList& list) : list_(list) {}

  void operator()(const figure::Area& area) const {
    std::vector<ImVec2> corners;
    for (const figure::Place& p : area.corners) corners.push_back(to_imgui(p));
    list_.AddConvexPolyFilled(corners.data(), static_cast<int>(corners.size()),
                              ui::to_imgui(area.fill));
    if (!area.outline) return;
    figure::Stroke around{area.corners, *area.outline};
    around.places.push_back(area.corners.front());
    (*this)(around);
  }

  void operator()(const figure::Stroke& stroke) const {
    for (std::size_t i = 0; i + 1 < stroke.places.size(); ++i) {
      segment(stroke.places[i], stroke.places[i + 1], stroke.pen);
    }
  }

  void operator()(const figure::Dot& dot) const {
    list_.AddCircleFilled(to_imgui(dot.middle), static_cast<float>(dot.radius),
                          ui::to_imgui(dot.fill));
  }

  void operator()(const figure::Text& text) const {
    if (text.text.empty()) return;
    ImFont* font = ImGui::GetFont();
    const auto size = static_cast<float>(text.size);
    const ImVec2 extent = font->CalcTextSizeA(size, 1e9F, 0, text.text.c_str());
    const float share = text.anchor == figure::Anchor::start    ? 0.0F
                        : text.anchor == figure::Anchor::middle ? 0.5F
                                                                : 1.0F;
    const float scale = size / font->FontSize;
    const ImVec2 corner = {std::round(static_cast<float>(text.at.x) - share * extent.x),
                           std::round(static_cast<float>(text.at.y) - font->Ascent * scale)};
    if (text.patch.alpha > 0) {
      list_.AddRectFilled(corner, {corner.x + extent.x, corner.y + extent.y},
                          ui::to_imgui(text.patch));
    }
    list_.AddText(font, size, corner, ui::to_imgui(text.colour), text.text.c_str());
  }

 private:
  void segment(const figure::Place& from, const figure::Place& to, const figure::Pen& pen) const {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const double dash = pen.dashed ? figure::dash_length(pen) : std::max(length, 1.0);
    const auto on_line = [&](double at) {
      const double t = length > 0 ? std::min(at / length, 1.0) : 0;
      return to_imgui({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
    };
    for (double at = 0; at < length; at += 2 * dash) {
      list_.AddLine(on_line(at), on_line(at + dash), ui::to_imgui(pen.colour),
                    static_cast<float>(pen.width));
    }
  }

  ImDrawList& list_;
};

Colour light(std::uint8_t alpha) {
  Colour colour = kPointedColour;
  colour.alpha = alpha;
  return colour;
}

/// What is pointed at: light behind words and lines, and over areas.
class Light {
 public:
  explicit Light(const CanvasPainter& painter) : painter_(painter) {}

  void behind(const figure::Shape& shape) const {
    if (const auto* stroke = std::get_if<figure::Stroke>(&shape)) {
      figure::Stroke wide = *stroke;
      wide.pen = {light(255), 2 * stroke->pen.width + 4, false};
      painter_(wide);
    }
  }

  /// Words of one name lie close together: the light of all of them comes before the first.
  void behind_words(const LinkedDrawing& drawing, std::size_t first, const Pointed& pointed) const {
    const auto& shapes = drawing.drawing.shapes;
    for (std::size_t i = first; i < shapes.size(); ++i) {
      const auto* text = std::get_if<figure::Text>(&shapes[i]);
      if (text == nullptr) return;
      if (!pointed.contains(drawing.meanings[i].vertices)) continue;
      const figure::Box box = figure::box_of(*text);
      painter_(figure::Dot{
          {(box.left + box.right) / 2, (box.top + box.bottom) / 2}, 0.8 * text->size, light(255)});
    }
  }

  void over(const figure::Shape& shape) const {
    const auto* area = std::get_if<figure::Area>(&shape);
    if (area != nullptr) painter_(figure::Area{area->corners, light(90), {}});
  }

 private:
  const CanvasPainter& painter_;
};

}  // namespace

Colour colour_of(ImGuiCol part) {
  const ImVec4 colour = ImGui::GetStyleColorVec4(part);
  const auto byte = [](float x) { return static_cast<std::uint8_t>(std::lround(255 * x)); };
  return {byte(colour.x), byte(colour.y), byte(colour.z), byte(colour.w)};
}

void coloured_text(const Colour& colour, const std::string& text) {
  constexpr float kLighter = 0.4F;
  constexpr int kLight = 128;
  ImVec4 shown = ImGui::ColorConvertU32ToFloat4(to_imgui(colour));
  if (colour_of(ImGuiCol_Text).green > kLight) {
    for (float* part : {&shown.x, &shown.y, &shown.z}) *part += kLighter * (1 - *part);
  }
  ImGui::TextColored(shown, "%s", text.c_str());
}

void paint(const figure::Drawing& drawing, ImDrawList& list) {
  const CanvasPainter painter(list);
  for (const figure::Shape& shape : drawing.shapes) std::visit(painter, shape);
}

void show_mark(Outcome outcome) {
  constexpr double kMark = 0.8;  // of the size of the text
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const double size = ImGui::GetFontSize();
  const double margin = (1 - kMark) / 2 * size;
  figure::Drawing drawing;
  add_mark(drawing, outcome, {at.x + margin, at.y + margin}, kMark * size);
  paint(drawing, *ImGui::GetWindowDrawList());
  ImGui::Dummy({ImGui::GetFontSize(), ImGui::GetFontSize()});
}

Square square_at_cursor(float side) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  return {{corner.x + side / 2.0, corner.y + side / 2.0}, side / 2.0};
}

void show_linked(const char* id, std::span<const LinkedDrawing> drawings, float side,
                 Document& document) {
  ImGui::InvisibleButton(id, {side, side});
  const bool is_hovered = ImGui::IsItemHovered();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const CanvasPainter painter(*ImGui::GetWindowDrawList());
  const Light light(painter);
  const Pointed& pointed = document.pointed();
  for (const LinkedDrawing& drawing : drawings) {
    for (std::size_t i = 0; i < drawing.meanings.size(); ++i) {
      const figure::Shape& shape = drawing.drawing.shapes[i];
      const bool is_lit = pointed.contains(drawing.meanings[i].vertices);
      const auto is_word = [&](std::size_t k) {
        return std::holds_alternative<figure::Text>(drawing.drawing.shapes[k]);
      };
      if (is_word(i) && (i == 0 || !is_word(i - 1))) light.behind_words(drawing, i, pointed);
      if (is_lit) light.behind(shape);
      std::visit(painter, shape);
      if (is_lit) light.over(shape);
    }
    const Meaning* meaning =
        is_hovered ? meaning_at(drawing, {mouse.x, mouse.y}, 0.8 * ImGui::GetFontSize()) : nullptr;
    if (meaning == nullptr) continue;
    if (!meaning->tip.empty()) ImGui::SetTooltip("%s", meaning->tip.c_str());
    if (!meaning->vertices.empty()) document.hovering = {meaning->vertices};
  }
}

}  // namespace tetmend::viewer::ui
