// SPDX-License-Identifier: MIT
#include "viewer/ui/drawing_canvas.h"

#include <cmath>
#include <vector>

#include "viewer/ui/flat_canvas.h"

namespace tetmend::viewer::ui {

namespace {

ImVec2 to_imgui(const figure::Place& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

class Painter {
 public:
  explicit Painter(ImDrawList& list) : list_(list) {}

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

}  // namespace

void paint(const figure::Drawing& drawing, ImDrawList& list) {
  const Painter painter(list);
  for (const figure::Shape& shape : drawing.shapes) std::visit(painter, shape);
}

}  // namespace tetmend::viewer::ui
