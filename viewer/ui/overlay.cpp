// SPDX-License-Identifier: MIT
#include "viewer/ui/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/mesh/visibility.h"
#include "viewer/ui/flat_canvas.h"

namespace tetmend::viewer::ui {

namespace {

struct Box {
  ImVec2 low, high;
  bool overlaps(const Box& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
           other.low.y < high.y;
  }
};

Colour colour_of(const std::string& role) {
  if (role == "a" || role == "b" || role == "v") return kSupportingEdgeColour;
  return kSkirtColour;
}

class Overlay {
 public:
  explicit Overlay(Document& document) : document_(document) {
    const glm::ivec2 corner = document.canvas_corner;
    low_ = {static_cast<float>(corner.x), static_cast<float>(corner.y)};
    high_ = {low_.x + static_cast<float>(document.canvas.width),
             low_.y + static_cast<float>(document.canvas.height)};
    list_->PushClipRect(low_, high_);
  }
  ~Overlay() { list_->PopClipRect(); }
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Numbers that would cover others are left out; those with a role come first.
  void names() {
    for (const NamedVertex& name : document_.names()) {
      const auto at = pixel_of(name.vertex);
      if (at) write(name, *at);
    }
  }

  void pointed() {
    const Pointed& pointed = document_.pointed();
    std::vector<ImVec2> pixels;
    for (const VertexHandle v : pointed.vertices) {
      const auto at = is_there(v) ? pixel_of(v) : std::nullopt;
      if (!at) return;
      pixels.push_back(*at);
    }
    Colour faint = kPointedColour;
    faint.alpha = 70;
    if (pixels.size() == 3) {
      list_->AddTriangleFilled(pixels[0], pixels[1], pixels[2], to_imgui(faint));
    }
    constexpr std::size_t kMost = 4;
    for (std::size_t i = 0; i < pixels.size() && pixels.size() <= kMost; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        list_->AddLine(pixels[i], pixels[j], to_imgui(kPointedColour), font_ / 3);
      }
      list_->AddCircle(pixels[i], 0.6F * font_, to_imgui(kPointedColour), 0, font_ / 4);
    }
  }

  void legend() {
    const auto& entries = document_.legend();
    if (entries.empty()) return;
    const float line = 1.25F * font_;
    float widest = 0;
    for (const LegendEntry& entry : entries) {
      widest = std::max(widest, ImGui::CalcTextSize(entry.text.c_str()).x);
    }
    const float height = line * static_cast<float>(entries.size());
    const ImVec2 corner = {low_.x + 0.6F * font_, high_.y - height - 0.6F * font_};
    list_->AddRectFilled({corner.x - 0.3F * font_, corner.y - 0.3F * font_},
                         {corner.x + widest + 2.3F * font_, corner.y + height + 0.2F * font_},
                         patch(0.8F), 4);
    float y = corner.y;
    for (const LegendEntry& entry : entries) {
      list_->AddRectFilled({corner.x, y + 0.2F * font_}, {corner.x + 1.4F * font_, y + font_},
                           to_imgui(entry.colour), 2);
      list_->AddText({corner.x + 1.8F * font_, y}, ImGui::GetColorU32(ImGuiCol_Text),
                     entry.text.c_str());
      y += line;
    }
  }

 private:
  static ImU32 patch(float opacity) {
    ImVec4 colour = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
    colour.w = opacity;
    return ImGui::GetColorU32(colour);
  }
  bool is_there(VertexHandle v) const {
    const TetMesh& mesh = document_.mesh();
    return v.index() < mesh.vertex_slots() && !mesh.is_deleted(v);
  }
  std::optional<ImVec2> pixel_of(VertexHandle v) const {
    const auto at =
        document_.view.camera.project(to_glm(document_.mesh().point(v)), document_.canvas);
    if (!at) return std::nullopt;
    return ImVec2{low_.x + static_cast<float>(at->x), low_.y + static_cast<float>(at->y)};
  }

  void write(const NamedVertex& name, ImVec2 at) {
    const std::string number = fmt::format("{}", name.vertex.index());
    const std::string role = name.role.empty() ? "" : name.role + " ";
    const ImVec2 left = ImGui::CalcTextSize(role.c_str());
    const ImVec2 right = ImGui::CalcTextSize(number.c_str());
    const ImVec2 corner = {at.x + 0.35F * font_, at.y - 1.2F * font_};
    const Box box = {corner, {corner.x + left.x + right.x, corner.y + right.y}};
    for (const Box& other : taken_) {
      if (box.overlaps(other)) return;
    }
    taken_.push_back(box);
    list_->AddCircleFilled(at, 0.16F * font_, ImGui::GetColorU32(ImGuiCol_Text));
    list_->AddRectFilled({box.low.x - 2, box.low.y}, {box.high.x + 2, box.high.y}, patch(0.75F), 3);
    list_->AddText(corner, to_imgui(colour_of(name.role)), role.c_str());
    list_->AddText({corner.x + left.x, corner.y}, ImGui::GetColorU32(ImGuiCol_Text),
                   number.c_str());
  }

  Document& document_;
  ImDrawList* list_ = ImGui::GetBackgroundDrawList();
  float font_ = ImGui::GetFontSize();
  ImVec2 low_, high_;
  std::vector<Box> taken_;
};

}  // namespace

bool has_overlay(Document& document) {
  if (!document.has_mesh()) return false;
  return (document.view.numbers && !document.names().empty()) || !document.pointed().is_nothing();
}

void point_by_mouse(Document& document, float x, float y) {
  constexpr float kReach = 0.75F;
  const glm::dvec2 at = document.to_canvas(x, y);
  const bool is_inside =
      at.x >= 0 && at.y >= 0 && at.x < document.canvas.width && at.y < document.canvas.height;
  if (!is_inside || !document.has_mesh()) return;
  document.hovering = document.find_named(x, y, kReach * ImGui::GetFontSize());
}

void draw_overlay(Document& document) {
  if (!document.has_mesh()) return;
  Overlay overlay(document);
  overlay.pointed();
  if (document.view.numbers) overlay.names();
  const bool is_explained = document.view.legend && document.show_panels;
  if (is_explained && document.debugger() != nullptr) overlay.legend();
}

}  // namespace tetmend::viewer::ui
