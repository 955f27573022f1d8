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
  std::string (*value)(const MeshStatistics& s);
};

constexpr Row kRows[] = {
    {"tets", [](const MeshStatistics& s) { return grouped(s.tets); }},
    {"vertices", [](const MeshStatistics& s) { return grouped(s.vertices); }},
    {"triangles", [](const MeshStatistics& s) { return grouped(s.boundary_triangles); }},
    {"theta_min", [](const MeshStatistics& s) { return fmt::format("{:.3f}°", s.theta_min); }},
    {"theta_max", [](const MeshStatistics& s) { return fmt::format("{:.3f}°", s.theta_max); }},
    {"lambda", [](const MeshStatistics& s) { return fmt::format("{:.3f} %", s.lambda); }},
    {"bad tets", [](const MeshStatistics& s) { return grouped(s.n_bad); }},
    {"worst sine", [](const MeshStatistics& s) { return fmt::format("{:.4f}", s.q_worst); }},
    {"mean bad sine", [](const MeshStatistics& s) { return fmt::format("{:.4f}", s.q_aver); }},
    {"inverted", [](const MeshStatistics& s) { return grouped(s.inverted); }},
    {"volume", [](const MeshStatistics& s) { return volume_text(s, 6); }},
};

}  // namespace

void draw_statistics_panel(Session& session) {
  const Document& document = session.document;
  const auto& before = document.statistics_before();
  if (!ImGui::BeginTable("##statistics", before ? 3 : 2, ImGuiTableFlags_RowBg)) return;
  if (before) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed,
                            ImGui::CalcTextSize("mean bad sine").x);
    ImGui::TableSetupColumn("before");
    ImGui::TableSetupColumn("now");
    ImGui::TableHeadersRow();
  }
  for (const Row& row : kRows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", row.name);
    if (before) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(row.value(*before).c_str());
    }
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.value(document.statistics()).c_str());
  }
  ImGui::EndTable();
  for (const std::string& note : document.notes()) wrapped_text(note);
}

}  // namespace tetmend::viewer::ui
