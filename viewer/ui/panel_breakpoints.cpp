// SPDX-License-Identifier: MIT
// Places to run to, breakpoints, bookmarks.
#include <array>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/ui/panels.h"

namespace tetmend::viewer::ui {

namespace {

/// What may be typed, as a list to choose from.
constexpr std::array<const char*, 15> kExamples = {"accepted for good",
                                                   "accepted",
                                                   "undone",
                                                   "operator smoothing and refused",
                                                   "refused",
                                                   "deeper 2",
                                                   "level 3 and accepted",
                                                   "operator edge_removal",
                                                   "edge 3 17 and refused",
                                                   "face 1 2 3",
                                                   "vertex 5",
                                                   "tet 4711 for good",
                                                   "worse than 0.2",
                                                   "verdict depth_spent",
                                                   "near 0 0 0 1"};

bool is_condition(const std::string& text) {
  try {
    parse_condition(text);
  } catch (const Error&) {
    return false;
  }
  return true;
}

void show_run_to(Session& session) {
  std::string& text = session.document.debugger()->typed_condition;
  ImGui::SetNextItemWidth(-2 * ImGui::GetFontSize());
  if (ImGui::InputTextWithHint("##place", "edge 3 17", &text,
                               ImGuiInputTextFlags_EnterReturnsTrue)) {
    const char* command = ImGui::GetIO().KeyShift ? "run_to" : "list_calls";
    run_from_window(find_command(command), session, {text});
    if (!is_condition(text))
      ImGui::SetKeyboardFocusHere(-1);  // to be put right, not to act as keys
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Enter lists, Shift+Enter runs to the next");
  ImGui::SameLine();
  if (ImGui::ArrowButton("##examples", ImGuiDir_Down)) ImGui::OpenPopup("examples");
  if (ImGui::BeginPopup("examples")) {
    for (const char* example : kExamples) {
      if (ImGui::Selectable(example)) text = example;
    }
    ImGui::EndPopup();
  }
  if (ImGui::Button("list")) run_from_window(find_command("list_calls"), session, {text});
  ImGui::SameLine();
  if (ImGui::Button("run to next")) run_from_window(find_command("run_to"), session, {text});
  ImGui::SameLine();
  if (ImGui::Button("before")) run_from_window(find_command("run_to"), session, {text, "back"});
  ImGui::SameLine();
  if (ImGui::Button("breakpoint")) run_from_window(find_command("breakpoint"), session, {text});
}

void show_breakpoints(Debugger& debugger) {
  std::size_t gone = debugger.breakpoints.size();
  for (std::size_t i = 0; i < debugger.breakpoints.size(); ++i) {
    Breakpoint& b = debugger.breakpoints[i];
    ImGui::PushID(static_cast<int>(i));
    ImGui::Checkbox(to_text(b.condition).c_str(), &b.on);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - 1.5F * ImGui::GetFontSize());
    if (ImGui::SmallButton("x")) gone = i;
    ImGui::PopID();
  }
  if (gone < debugger.breakpoints.size()) {
    debugger.breakpoints.erase(debugger.breakpoints.begin() + static_cast<std::ptrdiff_t>(gone));
  }
}

void show_bookmarks(Session& session) {
  const auto marks = session.document.debugger()->bookmarks;  // a click may change them
  for (const auto& mark : marks) {
    const std::string name = fmt::format("{}: {}", mark.first, mark.second);
    if (ImGui::Selectable(name.c_str(), mark.first == session.document.debugger()->position())) {
      run_from_window(find_command("seek"), session, {mark.first});
    }
  }
}

}  // namespace

void draw_breakpoints_panel(Session& session) {
  Debugger& debugger = *session.document.debugger();
  show_run_to(session);
  show_breakpoints(debugger);
  if (ImGui::Button("bookmark")) run_from_window(find_command("bookmark"), session);
  ImGui::SameLine();
  if (ImGui::Button("deepest call")) run_from_window(find_command("deepest"), session);
  show_bookmarks(session);
  ImGui::Checkbox("isolate the call", &session.document.view.scene.isolate);
  ImGui::SameLine();
  ImGui::Checkbox("follow", &session.document.follow_trace);
}

}  // namespace tetmend::viewer::ui
