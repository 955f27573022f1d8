// SPDX-License-Identifier: MIT
// Colours, regions, and what else is drawn.
#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "kernel/error.h"
#include "kernel/spaced.h"
#include "viewer/mesh/tet_values.h"
#include "viewer/overlay.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/slider.h"

namespace tetmend::viewer::ui {

namespace {

/// Names stand left of what they name, in one column.
void name(const char* text) {
  constexpr float kNames = 0.36F;  // of the width
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  ImGui::SameLine(kNames * ImGui::GetContentRegionMax().x);
  ImGui::SetNextItemWidth(-1);
}

void choose_colour(SceneSettings& scene, bool has_reference) {
  name("colour");
  if (ImGui::BeginCombo("##colour", spaced(scene.colour).c_str())) {
    if (ImGui::Selectable("region", scene.colour == "region")) scene.colour = "region";
    if (has_reference && ImGui::Selectable(kDistance, scene.colour == kDistance)) {
      scene.colour = kDistance;
    }
    for (const TetValue& value : tet_values()) {
      if (ImGui::Selectable(spaced(value.name).c_str(), scene.colour == value.name)) {
        scene.colour = value.name;
        if (scene.measure != value.name) scene.filtered = false;
        scene.measure = value.name;
      }
    }
    ImGui::EndCombo();
  }
  name("map");
  if (ImGui::BeginCombo("##map", scene.map.c_str())) {
    for (const ColourMap& map : colour_maps()) {
      if (ImGui::Selectable(map.name.data(), scene.map == map.name)) scene.map = map.name;
    }
    ImGui::EndCombo();
  }
}

void slide(const char* title, double& value, double low, double high, const char* format) {
  name(title);
  slider(fmt::format("##{}", title).c_str(), ImGuiDataType_Double, &value, &low, &high, format);
}

/// On without a reference, it asks for one.
void choose_reference(Session& session) {
  Document& document = session.document;
  bool is_on = document.view.scene.colour == kDistance && document.reference() != nullptr;
  if (ImGui::Checkbox("reference surface", &is_on)) {
    run_from_window(find_command("reference"), session);
  }
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("the surface by its distance from another one, which is seen as a ghost");
  }
  if (!is_on || document.reference() == nullptr) return;
  slide("its ghost", document.view.scene.reference, 0, 1, "%.2f");
  ImGui::Checkbox("both ways", &document.view.scene.both_ways);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip(
        "also how far the reference lies from the surface: the larger distance at each place");
  }
  for (const std::string& line : departure_in_words(document)) {
    ImGui::TextWrapped("%s", line.c_str());
  }
}

/// A new goal counts when Enter is pressed: it takes a pass over the mesh.
void choose_goal(Document& document) {
  const Goal now = document.mesh().standard().goal();
  std::array<double, 2> angles = {now.min_angle, now.max_angle};
  const bool is_trace = document.debugger() != nullptr;
  ImGui::BeginDisabled(is_trace);
  name("goal");
  const bool changed =
      ImGui::InputScalarN("##goal", ImGuiDataType_Double, angles.data(), 2, nullptr, nullptr,
                          "%.4g°", ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip(
        "smallest and largest angle of a good tet, also for live runs; Enter sets it");
  }
  if (!changed || is_trace) return;
  try {
    document.set_goal({angles[0], angles[1]});
  } catch (const Error& error) {
    document.message = {error.what(), true};
  }
}

/// Only where there are several; a long list would drown the rest.
void choose_regions(const std::vector<Label>& regions, SceneSettings& scene) {
  constexpr std::size_t kMost = 24;
  if (regions.size() < 2) return;
  ImGui::TextDisabled("regions");
  for (std::size_t i = 0; i < std::min(regions.size(), kMost); ++i) {
    const Label label = regions[i];
    const Colour c = region_colour(label);
    auto& hidden = scene.hidden_regions;
    const auto found = std::find(hidden.begin(), hidden.end(), label);
    bool shown = found == hidden.end();
    const ImVec4 tint(static_cast<float>(c.red) / 255, static_cast<float>(c.green) / 255,
                      static_cast<float>(c.blue) / 255, 1);
    const std::string title = fmt::format("{}", label);
    ImGui::ColorButton(title.c_str(), tint, ImGuiColorEditFlags_NoTooltip);
    ImGui::SameLine();
    if (ImGui::Checkbox(title.c_str(), &shown)) {
      if (shown) {
        hidden.erase(found);
      } else {
        hidden.push_back(label);
      }
    }
    if (i % 3 != 2 && i + 1 < regions.size()) ImGui::SameLine();
  }
  ImGui::NewLine();
}

}  // namespace

void draw_display_panel(Session& session) {
  ViewSettings& view = session.document.view;
  SceneSettings& scene = view.scene;
  choose_colour(scene, session.document.reference() != nullptr);
  choose_goal(session.document);
  ImGui::Checkbox("bad tets in red", &scene.bad);
  if (ImGui::IsItemHovered()) {
    const Standard& standard = session.document.mesh().standard();
    if (standard.is_own()) {
      ImGui::SetTooltip("a quality below 1 by %s", std::string(standard.measure_name()).c_str());
    } else {
      ImGui::SetTooltip("misses the goal: an angle below %g° or above %g°",
                        standard.goal().min_angle, standard.goal().max_angle);
    }
  }
  ImGui::SameLine();
  ImGui::BeginDisabled(!scene.bad);
  ImGui::Checkbox("beyond cuts", &scene.bad_beyond_cuts);
  ImGui::EndDisabled();
  slide("bad below", scene.bad_below, 0, 2, "%.2f");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("tets of a lower quality are bad; with 1 the goal is just met");
  ImGui::Checkbox("edges", &view.edges);
  ImGui::SameLine();
  ImGui::Checkbox("constraints", &scene.constraints);
  ImGui::SameLine();
  ImGui::Checkbox("outline", &scene.outline);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("the mesh, faint, around what a filter or isolation leaves of it");
  }
  constexpr int kMostLayers = 20;
  name("peel");
  const int none = 0;
  const int most = std::max(kMostLayers, scene.peel);
  slider("##peel", ImGuiDataType_S32, &scene.peel, &none, &most, "%d layers");
  scene.peel = std::max(scene.peel, 0);
  slide("shrink", scene.shrink, 0, 0.9, "%.2f");
  slide("ghosts", scene.ghosts, 0, 1, "%.2f");
  ImGui::Checkbox("numbers", &view.numbers);
  ImGui::SameLine();
  choose_reference(session);
  scene.shrink = std::clamp(scene.shrink, 0.0, 0.9);
  scene.ghosts = std::clamp(scene.ghosts, 0.0, 1.0);
  scene.reference = std::clamp(scene.reference, 0.0, 1.0);
  choose_regions(session.document.regions(), scene);
}

}  // namespace tetmend::viewer::ui
