// SPDX-License-Identifier: MIT
// The text of a lesson beside its trace.
#include <imgui.h>

#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

void draw_lesson_panel(Session& session) {
  const Debugger& debugger = *session.document.debugger();
  const Lesson& lesson = *debugger.lesson();
  const auto step = step_at(lesson, debugger.position());
  wrapped_text(lesson.title);
  if (ImGui::Button("back")) run_from_window(find_command("last_lesson_step"), session);
  ImGui::SameLine();
  if (ImGui::Button("next")) run_from_window(find_command("next_lesson_step"), session);
  ImGui::SameLine();
  ImGui::TextDisabled("step %zu of %zu", step ? *step + 1 : 0, lesson.steps.size());
  if (!step || lesson.steps[*step].at != debugger.position()) return draw_last_event(session);
  for (const LessonStep& told : lesson.steps) {  // all that are at this position
    if (told.at != lesson.steps[*step].at) continue;
    wrapped_text(told.text);
    if (told.ask) wrapped_text(told.ask->text);
  }
}

}  // namespace tetmend::viewer::ui
