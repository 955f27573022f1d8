// SPDX-License-Identifier: MIT
// The text of a lesson beside its trace.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

constexpr float kFinger = 32;  // pixels at the usual size of the text, at least

/// Higher than those of panels: to be met by fingers, and from the back of a hall.
void lesson_buttons(Session& session) {
  const float text = ImGui::GetFontSize();
  const float height = std::max(1.8F * text, kFinger * ImGui::GetFontSize() / 16);
  const ImVec2 size = {5.5F * text, height};
  if (ImGui::Button("back", size)) run_from_window(find_command("last_lesson_step"), session);
  ImGui::SameLine();
  if (ImGui::Button("next", size)) run_from_window(find_command("next_lesson_step"), session);
}

std::string place_in(const Lesson& lesson, const Debugger& debugger) {
  const auto step = step_at(lesson, debugger.position());
  return fmt::format("step {} of {}", step ? *step + 1 : 0, lesson.steps.size());
}

}  // namespace

void draw_lesson_text(Session& session) {
  const Debugger& debugger = *session.document.debugger();
  const Lesson& lesson = *debugger.lesson();
  const auto step = step_at(lesson, debugger.position());
  if (!step || lesson.steps[*step].at != debugger.position()) return draw_last_event(session);
  for (const LessonStep& told : lesson.steps) {  // all that are at this position
    if (told.at != lesson.steps[*step].at) continue;
    wrapped_text(told.text);
    if (told.ask) wrapped_text(told.ask->text);
  }
}

void draw_lesson_bar(Session& session) {
  const Debugger& debugger = *session.document.debugger();
  const Lesson& lesson = *debugger.lesson();
  lesson_buttons(session);
  const float right = ImGui::GetItemRectMax().x;
  const float middle = (ImGui::GetItemRectMin().y + ImGui::GetItemRectMax().y) / 2;
  const std::string text = fmt::format("{}: {}", place_in(lesson, debugger), lesson.title);
  draw_indexed(*ImGui::GetWindowDrawList(),
               {right + ImGui::GetFontSize(), middle - ImGui::GetFontSize() / 2},
               ImGui::GetColorU32(ImGuiCol_TextDisabled), text);
}

void draw_lesson_panel(Session& session) {
  const Debugger& debugger = *session.document.debugger();
  const Lesson& lesson = *debugger.lesson();
  wrapped_text(lesson.title);
  lesson_buttons(session);
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", place_in(lesson, debugger).c_str());
  draw_lesson_text(session);
}

}  // namespace tetmend::viewer::ui
