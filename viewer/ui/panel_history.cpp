// SPDX-License-Identifier: MIT
// What a trace knows of one tet, face, edge or vertex.
#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "kernel/spaced.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/drawing_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

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
    std::string text = fmt::format("{}{}: {} calls, {} accepted for good, {} undone",
                                   in_words(part.part), part.on_surface ? ", on the surface" : "",
                                   part.calls, part.accepted, part.undone);
    if (part.nearest != kNoCall) {
      const Call& call = file.calls()[part.nearest];
      if (!call.accepted()) text += fmt::format("; nearest {}", part.nearest);
    }
    if (wrapped_row(text, false)) asked = as_question(part.part);
    if (ImGui::IsItemHovered()) session.document.hovering = {part.part};
  }
  if (!asked.empty()) run_from_window(find_command("history"), session, {asked});
}

/// What the mark does not tell: qualities where there are any.
std::string ending_of(const Call& call) {
  if (call.accepted() && call.undone) return call.verdict_in_words();
  if (call.worst_before == 0 && call.worst_after == 0) return call.verdict_in_words();
  return fmt::format("{:.4f} -> {:.4f}", call.worst_before, call.worst_after);
}

constexpr std::string_view kLongest = "0.0000 -> 0.0000";

/// A row of a table: mark, number, what was asked for, how it ended. True: it was clicked.
bool show_call(Session& session, std::uint32_t number) {
  const Debugger& debugger = *session.document.debugger();
  const Call& call = debugger.file().calls()[number];
  const std::string name = short_name(debugger.file(), call);
  const std::string ending = ending_of(call);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  show_mark(outcome_of(call));
  ImGui::TableNextColumn();
  right_aligned(fmt::format("{}", number));
  ImGui::TableNextColumn();
  ImGui::PushID(static_cast<int>(number));
  const bool is_clicked =
      wrapped_row(fmt::format("{} {}", name, numbers_of(call)), debugger.call() == number,
                  ImGuiSelectableFlags_SpanAllColumns);
  if (ImGui::IsItemHovered()) {
    session.document.hovering = session.document.pointed_call(number);
    const std::string reason(debugger.file().reason(call));
    ImGui::SetTooltip("%u %s %s: %s, %s\n%s", number, name.c_str(), format_target(call).c_str(),
                      call.verdict_in_words().c_str(), ending.c_str(), reason.c_str());
  }
  ImGui::PopID();
  ImGui::TableNextColumn();
  wrapped_text(ending);
  return is_clicked;
}

/// A click goes to the call.
void show_calls(Session& session, const History& history, bool in_trials) {
  const std::size_t all = session.document.debugger()->file().calls().size();
  std::uint32_t chosen = kNoCall;
  if (!ImGui::BeginTable("##history", 4, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize());
  number_column("call", fmt::format("{}", all));
  ImGui::TableSetupColumn("target", ImGuiTableColumnFlags_WidthStretch);
  number_column("", std::string(kLongest));
  for (const HistoryCall& each : history.calls) {
    if (each.in_trial == in_trials && show_call(session, each.call)) chosen = each.call;
  }
  ImGui::EndTable();
  if (chosen != kNoCall) run_from_window(find_command("enter"), session, {chosen});
}

/// Goes to where it is, if need be to when it was there last.
void show_subject(Session& session, const History& history) {
  if (!ImGui::Button("show")) return;
  Document& document = session.document;
  guarded(document, [&] {
    Selection found = document.selection_of(history.subject);
    if (found == Selection()) {
      Debugger& debugger = *document.debugger();
      debugger.seek(history.removed.value_or(debugger.end()));
      document.show_trace();
      found = document.selection_of(history.subject);
    }
    if (found != Selection()) document.fly_to(found);
  });
}

/// A click goes to where a pass turned to the tet.
void list_visits(Session& session, const History& history) {
  const TraceFile& file = session.document.debugger()->file();
  std::optional<std::uint64_t> chosen;
  for (const std::uint32_t number : history.visits) {
    const Visit& visit = file.visits()[number];
    const auto around =
        std::find_if(file.passes().begin(), file.passes().end(),
                     [&](const TracedPass& pass) { return visit.events.begin < pass.events.end; });
    std::string text =
        fmt::format("visit {}: {} calls", number, visit.last_call - visit.first_call);
    if (around != file.passes().end()) {
      text += fmt::format(", {} {}", spaced(file.name(around->name)), around->round);
    }
    if (wrapped_row(text, session.document.debugger()->visit() == number)) {
      chosen = visit.events.begin + 1;
    }
    if (ImGui::IsItemHovered()) session.document.hovering = {history.subject};
  }
  if (chosen) run_from_window(find_command("seek"), session, {*chosen});
}

void list_what_there_was(Session& session, const History& history) {
  if (!history.visits.empty() && ImGui::TreeNode("visits by passes")) {
    list_visits(session, history);
    ImGui::TreePop();
  }
  if (history.calls.empty()) return;
  if (ImGui::TreeNodeEx("calls", ImGuiTreeNodeFlags_DefaultOpen)) {
    show_calls(session, history, false);
    ImGui::TreePop();
  }
  if (ImGui::TreeNode("calls in trials that were undone")) {
    show_calls(session, history, true);
    ImGui::TreePop();
  }
  if (history.subject.size() > 1 && ImGui::TreeNode("its parts")) {
    list_parts(session, history);
    ImGui::TreePop();
  }
}

}  // namespace

void draw_history_panel(Session& session) {
  ask_box(session);
  const std::optional<History> history = session.document.debugger()->history();
  if (!history) {
    ImGui::TextDisabled("right click on what you want to know of, or Shift+H for the selection");
    return;
  }
  const std::string text = history_paragraph(session.document.debugger()->file(), *history);
  const CallsInText named = wrapped_text_with_calls(text);
  if (named.hovered) session.document.hovering = session.document.pointed_call(*named.hovered);
  show_subject(session, *history);
  list_what_there_was(session, *history);
  if (named.clicked) run_from_window(find_command("enter"), session, {*named.clicked});
}

}  // namespace tetmend::viewer::ui
