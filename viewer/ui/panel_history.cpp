// SPDX-License-Identifier: MIT
// What a trace knows of one tet, face, edge or vertex; and the menu of a right click, which asks.
#include <array>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "explain/outcome_colour.h"
#include "viewer/ui/flat_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

std::string name_of(const HistorySubject& part, char between) {
  constexpr std::array<const char*, 5> kKinds = {"", "vertex", "edge", "face", "tet"};
  std::string text = kKinds[part.size()];
  for (std::size_t i = 0; i < part.size(); ++i) {
    text += fmt::format("{}{}", i == 0 ? (between == ',' ? ':' : ' ') : between, part[i].index());
  }
  return text;
}

void ask_box(Session& session) {
  Debugger& debugger = *session.document.debugger();
  ImGui::SetNextItemWidth(-3.5F * ImGui::GetFontSize());
  const bool entered =
      ImGui::InputTextWithHint("##asked", "tet:worst, tet:17@better.mesh, edge:3,5",
                               &debugger.asked, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  if (ImGui::Button("ask") || entered) {
    run_from_window(find_command("history"), session, {debugger.asked});
  }
}

/// A click asks about the part.
void list_parts(Session& session, const History& history) {
  const TraceFile& file = session.document.debugger()->file();
  std::string asked;
  for (const PartHistory& part : history.parts) {
    if (part.part.size() == history.subject.size()) continue;
    if (part.calls + part.in_trials == 0 && part.part.size() != 2) continue;
    std::string text =
        fmt::format("{}{}: {} calls, {} accepted", name_of(part.part, ' '),
                    part.on_surface ? ", on the surface" : "", part.calls, part.accepted);
    if (part.nearest != kNoCall) {
      const Call& call = file.calls()[part.nearest];
      if (!call.accepted()) text += fmt::format("; nearest {}", part.nearest);
    }
    if (ImGui::Selectable(text.c_str())) asked = name_of(part.part, ',');
  }
  if (!asked.empty()) run_from_window(find_command("history"), session, {asked});
}

/// A click goes to the call.
void list_calls(Session& session, const History& history, bool in_trials) {
  const Debugger& debugger = *session.document.debugger();
  std::uint32_t chosen = kNoCall;
  for (const HistoryCall& each : history.calls) {
    if (each.in_trial != in_trials) continue;
    const Call& call = debugger.file().calls()[each.call];
    std::string text = fmt::format("{} {} {}: {}", each.call, short_name(debugger.file(), call),
                                   format_target(call), call.verdict_text());
    if (call.worst_before != 0 || call.worst_after != 0) {
      text += fmt::format(", {:.4f} -> {:.4f}", call.worst_before, call.worst_after);
    }
    const Colour colour = outcome_colour(outcome_of(call));
    ImGui::ColorButton("##outcome", ImGui::ColorConvertU32ToFloat4(to_imgui(colour)),
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                       {0.6F * ImGui::GetFontSize(), 0.6F * ImGui::GetFontSize()});
    ImGui::SameLine();
    ImGui::PushID(static_cast<int>(each.call));
    if (ImGui::Selectable(text.c_str(), debugger.call() == each.call)) chosen = each.call;
    if (ImGui::IsItemHovered()) {
      const std::string reason(debugger.file().reason(call));
      ImGui::SetTooltip("%s", reason.c_str());
    }
    ImGui::PopID();
  }
  if (chosen != kNoCall) run_from_window(find_command("enter"), session, {chosen});
}

}  // namespace

void draw_history_panel(Session& session) {
  ask_box(session);
  const std::optional<History> history = session.document.debugger()->history();
  if (!history) {
    ImGui::TextDisabled("right click on the mesh, or Shift+H for the selection");
    return;
  }
  wrapped_text(history_paragraph(session.document.debugger()->file(), *history));
  if (history->calls.empty()) return;
  if (ImGui::TreeNodeEx("calls", ImGuiTreeNodeFlags_DefaultOpen)) {
    list_calls(session, *history, false);
    ImGui::TreePop();
  }
  if (ImGui::TreeNode("calls in trials that were undone")) {
    list_calls(session, *history, true);
    ImGui::TreePop();
  }
  if (history->subject.size() > 1 && ImGui::TreeNode("its parts")) {
    list_parts(session, *history);
    ImGui::TreePop();
  }
}

void offer_history(Session& session, std::span<const VertexHandle> subject) {
  if (subject.empty() || !ImGui::BeginPopupContextItem("##history")) return;
  constexpr std::array<const char*, 5> kTexts = {"", "History of this vertex",
                                                 "History of this edge", "History of this face",
                                                 "History of this tet"};
  if (ImGui::MenuItem(kTexts[subject.size()])) {
    run_from_window(find_command("history"), session,
                    {name_of({subject.begin(), subject.end()}, ',')});
  }
  ImGui::EndPopup();
}

void draw_choices(Session& session) {
  Document& document = session.document;
  if (document.offer_choices) ImGui::OpenPopup("##choices");
  document.offer_choices = false;
  if (!ImGui::BeginPopup("##choices")) return;
  constexpr std::array<const char*, 4> kTexts = {"", "History of this tet", "History of this edge",
                                                 "History of this vertex"};
  const std::size_t kind = document.selection().index();
  if (kind > 0 && document.debugger() != nullptr && ImGui::MenuItem(kTexts[kind], "Shift+H")) {
    run_from_window(find_command("history"), session);
  }
  ImGui::EndPopup();
}

}  // namespace tetmend::viewer::ui
