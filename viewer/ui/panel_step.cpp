// SPDX-License-Identifier: MIT
// Where the trace is: the stack as a breadcrumb, what happened last, why, and the way on.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "explain/removal.h"
#include "viewer/ui/drawing_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

void command_button(Session& session, const char* label, const char* command, bool same_line) {
  if (same_line) ImGui::SameLine();
  const Command& c = find_command(command);
  if (ImGui::Button(label)) run_from_window(c, session);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s (%s)", c.help.data(), c.keys.data());  // both are literals
  }
}

/// Wraps like text; a click goes to the beginning of the call.
void show_breadcrumb(Session& session, std::size_t most) {
  const Debugger& debugger = *session.document.debugger();
  const float right = ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x;
  const std::vector<std::uint32_t> stack = debugger.stack();  // a click changes it
  if (stack.empty()) ImGui::TextDisabled("outside of all calls");
  const std::size_t first = stack.size() - std::min(most, stack.size());
  if (first > 0) ImGui::TextDisabled("%zu around:", first);
  for (std::size_t i = first; i < stack.size(); ++i) {
    const Call& call = debugger.file().calls()[stack[i]];
    const std::string name = fmt::format("{}{} {}", i == 0 ? "" : "> ",
                                         short_name(debugger.file(), call), format_target(call));
    const float width = ImGui::CalcTextSize(name.c_str()).x;
    if (i > 0 && ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width < right) {
      ImGui::SameLine();
    }
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(name.c_str(), i + 1 == stack.size(), 0, {width, 0})) {
      run_from_window(find_command("enter"), session, {stack[i]});
    }
    if (ImGui::IsItemHovered()) {
      session.document.hovering = session.document.pointed_call(stack[i]);
    }
    ImGui::PopID();
  }
}

/// Which face a step of the recursion is to remove.
void show_removal(const Debugger& debugger) {
  if (debugger.call() == kNoCall) return;
  const auto removal = removal_of(debugger.file(), debugger.call());
  if (removal) wrapped_text(to_text(*removal));
}

void show_end(Debugger& debugger) {
  const CallStudy* study = debugger.study();
  if (study == nullptr) return;
  const Call& call = debugger.file().calls()[study->call];
  const std::string verdict = outcome_text(call, debugger.position());
  show_mark(debugger.position() < call.events.end ? Outcome::unfinished : outcome_of(call));
  ImGui::SameLine();
  ImGui::TextUnformatted(verdict.c_str());
  if (debugger.position() < call.events.end) return;
  wrapped_text(explain_end(debugger.file(), *study));
}

}  // namespace

void draw_step_buttons(Session& session, bool is_short) {
  const Debugger& debugger = *session.document.debugger();
  constexpr const char* kBack[] = {"back_into", "back_over", "back_out", "run_back"};
  constexpr const char* kOn[] = {"step_into", "step_over", "step_out", "run"};
  constexpr const char* kNames[] = {"into", "over", "out", "run"};
  const float column = 3.2F * ImGui::GetFontSize();
  const auto row = [&](const char* title, const char* const* commands) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", title);
    ImGui::PushID(title);
    for (int i = 0; i < 4; ++i) {
      ImGui::SameLine(column + static_cast<float>(i) * column);
      command_button(session, kNames[i], commands[i], false);
    }
    ImGui::PopID();
  };
  const char* play = debugger.playing ? "stop" : "play";
  row("on", kOn);
  if (is_short) {
    ImGui::SameLine(5 * column);
    command_button(session, play, "play", false);
  }
  row("back", kBack);
  if (is_short) return;
  command_button(session, play, "play", false);
  command_button(session, "slower", "slower", true);
  command_button(session, "faster", "faster", true);
  ImGui::SameLine();
  ImGui::TextDisabled("%g events a second", debugger.speed);
}

void draw_step_panel(Session& session) {
  draw_step_buttons(session);
  ImGui::Separator();
  draw_stack(session);
  draw_last_event(session);
}

void draw_stack(Session& session, std::size_t most) {
  show_breadcrumb(session, most);
  show_removal(*session.document.debugger());
}

void draw_last_event(Session& session) {
  Debugger& debugger = *session.document.debugger();
  std::string event = debugger.last_event();
  if (debugger.call() != kNoCall) {  // how it has ended stands beside the mark
    const Call& call = debugger.file().calls()[debugger.call()];
    const std::string ending = ": " + outcome_text(call, debugger.position());
    if (event.ends_with(ending)) event.resize(event.size() - ending.size());
  }
  ImGui::TextUnformatted(event.c_str());
  show_end(debugger);
}

}  // namespace tetmend::viewer::ui
