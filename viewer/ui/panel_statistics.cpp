// SPDX-License-Identifier: MIT
// The figures of the mesh, and of the state before when there is one.
#include <fmt/format.h>
#include <imgui.h>

#include "kernel/grouped.h"
#include "kernel/statistics.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

struct Row {
  const char* name;
  const char* help;
  std::string (*value)(const MeshStatistics& s);
};

constexpr Row kRows[] = {
    {"tets", "in the mesh", [](const MeshStatistics& s) { return grouped(s.tets); }},
    {"vertices", "in the mesh", [](const MeshStatistics& s) { return grouped(s.vertices); }},
    {"triangles", "of its boundary",
     [](const MeshStatistics& s) { return grouped(s.boundary_triangles); }},
    {"smallest angle", "theta_min: between two faces of a tet",
     [](const MeshStatistics& s) { return fmt::format("{:.3f}°", s.theta_min); }},
    {"largest angle", "theta_max: between two faces of a tet",
     [](const MeshStatistics& s) { return fmt::format("{:.3f}°", s.theta_max); }},
    {"bad angles", "lambda: their share of all angles",
     [](const MeshStatistics& s) { return fmt::format("{:.3f} %", s.lambda); }},
    {"bad tets", "n_bad: they miss the goal",
     [](const MeshStatistics& s) { return grouped(s.n_bad); }},
    {"worst sine", "q_worst: quality of the worst tet",
     [](const MeshStatistics& s) { return fmt::format("{:.4f}", s.q_worst); }},
    {"mean bad sine", "q_aver: mean quality of the bad tets",
     [](const MeshStatistics& s) { return fmt::format("{:.4f}", s.q_aver); }},
    {"inverted", "tets without a positive volume",
     [](const MeshStatistics& s) { return grouped(s.inverted); }},
    {"volume", "of all tets, in cubes of the lengths of the file",
     [](const MeshStatistics& s) { return volume_text(s, 6); }},
};

}  // namespace

void draw_statistics_panel(Session& session) {
  const Document& document = session.document;
  const auto& before = document.statistics_before();
  if (!ImGui::BeginTable("##statistics", before ? 3 : 2, ImGuiTableFlags_RowBg)) return;
  if (before) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed,
                            ImGui::CalcTextSize("smallest angle").x);
    ImGui::TableSetupColumn("before");
    ImGui::TableSetupColumn("now");
    headers_row(1);
  }
  for (const Row& row : kRows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", row.name);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", row.help);
    if (before) {
      ImGui::TableNextColumn();
      right_aligned(row.value(*before));
    }
    ImGui::TableNextColumn();
    right_aligned(row.value(document.statistics()));
  }
  ImGui::EndTable();
  for (const std::string& note : document.notes()) wrapped_text(note);
}

}  // namespace tetmend::viewer::ui
