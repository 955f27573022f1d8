// SPDX-License-Identifier: MIT
// The text of a lesson beside its trace.
#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

constexpr float kFinger = 32;  // pixels at the usual size of the text, at least

/// Of what is to be met by fingers, and from the back of a hall.
float finger_height() {
  return std::max(1.8F, kFinger / 16) * ImGui::GetFontSize();
}

void lesson_buttons(Session& session) {
  const ImVec2 size = {5.5F * ImGui::GetFontSize(), finger_height()};
  if (ImGui::Button("back", size)) run_from_window(find_command("last_lesson_step"), session);
  ImGui::SameLine();
  if (ImGui::Button("next", size)) run_from_window(find_command("next_lesson_step"), session);
}

std::string place_in(const Lesson& lesson, const Debugger& debugger) {
  const auto step = step_at(lesson, debugger.position());
  const auto [answered, right] = debugger.score();
  return fmt::format("step {} of {}{}", step ? *step + 1 : 0, lesson.steps.size(),
                     answered == 0 ? "" : fmt::format(", {} of {} right", right, answered));
}

/// Buttons where there is a choice of two, else a line to type in. Nothing where none is asked.
void ask_for_answer(Session& session) {
  LessonQuestion* open = session.document.debugger()->open_question();
  if (open == nullptr) return;
  const auto give = [&](const std::string& words) {
    run_from_window(find_command("answer"), session, {words});
  };
  const float text = ImGui::GetFontSize();
  const float height = finger_height();
  const float padding = (height - ImGui::GetTextLineHeight()) / 2;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, padding});
  if (open->question.ask.kind == Ask::Kind::accepted) {
    if (ImGui::Button("accepted", {0, height})) give("accepted");
    ImGui::SameLine();
    if (ImGui::Button("refused", {0, height})) give("refused");
  } else {
    static constexpr std::array<const char*, 4> kHints = {"a line", "", "two corners", "a number"};
    const auto kind = static_cast<std::size_t>(open->question.ask.kind);
    ImGui::SetNextItemWidth(8 * text);
    const bool is_entered = ImGui::InputTextWithHint("##answer", kHints[kind], &open->typed,
                                                     ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if (ImGui::Button("check", {0, height}) || is_entered) give(open->typed);
  }
  ImGui::PopStyleVar();
}

}  // namespace

void draw_lesson_text(Session& session) {
  const Debugger& debugger = *session.document.debugger();
  const Lesson& lesson = *debugger.lesson();
  const auto step = step_at(lesson, debugger.position());
  if (!step || lesson.steps[*step].at != debugger.position()) return draw_last_event(session);
  for (std::size_t n = 0; n < lesson.steps.size(); ++n) {  // all that are at this position
    if (lesson.steps[n].at != debugger.position()) continue;
    wrapped_text(lesson.steps[n].text);
    const LessonQuestion* question = debugger.question_of(n);
    if (question != nullptr) wrapped_text(question->text(question->is_right.has_value()));
  }
}

void draw_lesson_step(Session& session) {
  draw_lesson_text(session);
  ask_for_answer(session);
}

void draw_lesson_bar(Session& session) {
  Debugger& debugger = *session.document.debugger();
  const Lesson& lesson = *debugger.lesson();
  lesson_buttons(session);
  if (debugger.open_question() != nullptr) ImGui::SameLine(0, 2 * ImGui::GetStyle().ItemSpacing.x);
  ask_for_answer(session);
  const float right = ImGui::GetItemRectMax().x;
  const float middle = (ImGui::GetItemRectMin().y + ImGui::GetItemRectMax().y) / 2;
  const float left = right + ImGui::GetFontSize();
  const float room = ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x - left;
  const auto fits = [&](const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x <= room;
  };
  const std::string place = place_in(lesson, debugger);
  const std::string full = fmt::format("{}: {}", place, lesson.title);
  if (!fits(place)) return;  // the title of the window has the lesson
  draw_indexed(*ImGui::GetWindowDrawList(), {left, middle - ImGui::GetFontSize() / 2},
               ImGui::GetColorU32(ImGuiCol_TextDisabled), fits(full) ? full : place);
}

void draw_lesson_panel(Session& session) {
  const Debugger& debugger = *session.document.debugger();
  const Lesson& lesson = *debugger.lesson();
  wrapped_text(lesson.title);
  lesson_buttons(session);
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", place_in(lesson, debugger).c_str());
  draw_lesson_step(session);
}

}  // namespace tetmend::viewer::ui
