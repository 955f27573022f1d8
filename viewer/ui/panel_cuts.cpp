// SPDX-License-Identifier: MIT
// Up to three cut planes.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/ui/panels.h"
#include "viewer/ui/slider.h"

namespace tetmend::viewer::ui {

namespace {

void set_normal(CutPlane& cut, const char* name, const glm::dvec3& normal) {
  if (ImGui::SmallButton(name)) cut.normal = normal;
  ImGui::SameLine();
}

}  // namespace

void draw_cuts_panel(Session& session) {
  ViewSettings& view = session.document.view;
  for (std::size_t i = 0; i < view.scene.cuts.size(); ++i) {
    CutPlane& cut = view.scene.cuts[i];
    ImGui::PushID(static_cast<int>(i));
    ImGui::Checkbox(fmt::format("{}", i + 1).c_str(), &cut.on);
    if (cut.on) {
      ImGui::SameLine();
      ImGui::Checkbox("exact", &cut.exact);
      ImGui::SameLine();
      if (ImGui::SmallButton("flip")) {
        cut.normal = -cut.normal;
        cut.position = -cut.position;
      }
      constexpr double kLow = -1;
      constexpr double kHigh = 1;
      ImGui::SetNextItemWidth(-1);
      slider("##position", ImGuiDataType_Double, &cut.position, &kLow, &kHigh, "%.3f");
      set_normal(cut, "x", {1, 0, 0});
      set_normal(cut, "y", {0, 1, 0});
      set_normal(cut, "z", {0, 0, 1});
      set_normal(cut, "towards me", -view.camera.forward());
      ImGui::NewLine();
    } else {
      ImGui::SameLine();
      ImGui::TextDisabled("normal %.2g %.2g %.2g", cut.normal.x, cut.normal.y, cut.normal.z);
    }
    ImGui::PopID();
  }
}

}  // namespace tetmend::viewer::ui
