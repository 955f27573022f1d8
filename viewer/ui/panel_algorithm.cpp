// SPDX-License-Identifier: MIT
// The algorithm of the paper that the call at hand follows, with its line.
#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <imgui.h>

#include "explain/call_facts.h"
#include "explain/event_text.h"
#include "explain/paper_lines.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

constexpr float kCallerLines = 4.5F;  // below the code, with t
constexpr float kNumbers = 2.2F;      // width of their column, in units of the text
constexpr float kGap = 1;             // between its lines, in pixels

/// As high as all lines, or as there is room for. Gives how much smaller the lines must be to be seen
/// all.
float begin_lines(const Pseudocode& code, float lines_below) {
  const float all =
      static_cast<float>(code.lines.size()) * (ImGui::GetTextLineHeight() + kGap) + 4 * kGap;
  const float room =
      ImGui::GetContentRegionAvail().y - lines_below * ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("##lines", {0, std::min(all, std::max(room, 3 * ImGui::GetFontSize()))});
  return std::min(1.0F, room / all);
}

/// Of the current window: `share` of their size, or less, so that no line is cut.
void shrink_text(const Pseudocode& code, float share) {
  constexpr float kLeast = 0.6F;
  ImGui::SetWindowFontScale(1);
  float widest = 0;
  for (const std::string_view line : code.lines) {
    widest = std::max(widest, ImGui::CalcTextSize(line.data()).x);  // literals
  }
  const float needed = widest + kNumbers * ImGui::GetFontSize();
  const float fitting = std::min(share, ImGui::GetContentRegionAvail().x / needed);
  if (fitting < 1) ImGui::SetWindowFontScale(std::max(kLeast, fitting));
}

/// `is_new`: the line is to be brought into sight.
void show_code(const Pseudocode& code, unsigned line, bool is_new, bool is_whole) {
  wrapped_text(code.title);
  constexpr float kFew = 3.2F;  // of the caller, where the column is wide
  const float share = begin_lines(code, is_whole ? kFew : kCallerLines);
  shrink_text(code, is_whole ? share : 1);
  ImDrawList* list = ImGui::GetWindowDrawList();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, kGap});
  for (unsigned i = 1; i <= code.lines.size(); ++i) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (i == line) {
      list->AddRectFilled(
          {at.x - 2, at.y - 1},
          {at.x + ImGui::GetContentRegionAvail().x, at.y + ImGui::GetTextLineHeight() + 1},
          ImGui::GetColorU32(ImGuiCol_Header), 3);
    }
    ImGui::TextDisabled("%2u", i);
    ImGui::SameLine(kNumbers * ImGui::GetFontSize());
    indexed_text(code.lines[i - 1]);
    if (i == line && is_new) ImGui::SetScrollHereY(0.5F);
  }
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

/// True for some layouts after a move: sizes are known from the second on only.
bool is_new_place(std::uint64_t position) {
  constexpr int kLayouts = 4;
  ImGuiStorage* storage = ImGui::GetStateStorage();
  const int here = static_cast<int>(position) + 1;
  int* shown = storage->GetIntRef(ImGui::GetID("##shown"), 0);
  int* since = storage->GetIntRef(ImGui::GetID("##since"), 0);
  if (*shown != here) *since = 0;
  *shown = here;
  return (*since)++ < kLayouts;
}

/// Of an operator without an algorithm here: what it does, in one sentence.
void tell_purpose(const Registry& registry, const Debugger& debugger) {
  const Call& call = debugger.file().calls()[debugger.call()];
  const std::string_view name = debugger.file().name(call.operator_name);
  const auto operators = registry.operators();
  const auto found = std::find_if(operators.begin(), operators.end(),
                                  [&](const OperatorInfo* info) { return info->name == name; });
  const std::string purpose =
      found == operators.end() ? "an operator of a plugin" : std::string((*found)->help);
  wrapped_text(fmt::format("{}: {}", short_name(name), purpose));
}

}  // namespace

float algorithm_height(const Session& session) {
  constexpr float kMostLines = 16;
  const Debugger& debugger = *session.document.debugger();
  const auto& stack = debugger.stack();
  const CodePlace here =
      stack.empty() ? pass_place(debugger.file(), stack, debugger.position())
                    : code_place(debugger.file(), stack, stack.size() - 1, debugger.position());
  if (here.code == nullptr) {  // a sentence says what it does
    constexpr float kSentence = 3;
    return stack.empty()
               ? 0
               : kSentence * ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().WindowPadding.y;
  }
  return kMostLines * (ImGui::GetTextLineHeight() + kGap) +
         (kCallerLines + 1) * ImGui::GetTextLineHeightWithSpacing() +
         2 * ImGui::GetStyle().WindowPadding.y;
}

void draw_algorithm_panel(Session& session, bool is_whole) {
  const Debugger& debugger = *session.document.debugger();
  const auto& stack = debugger.stack();
  const auto place_of = [&](std::size_t i) {
    return code_place(debugger.file(), stack, i, debugger.position());
  };
  const CodePlace pass = pass_place(debugger.file(), stack, debugger.position());
  const CodePlace here = stack.empty() ? pass : place_of(stack.size() - 1);
  if (here.code == nullptr) {
    if (!stack.empty()) tell_purpose(session.document.live.registry(), debugger);
    return;
  }
  show_code(*here.code, here.line, is_new_place(debugger.position()), is_whole);
  const auto visit = debugger.visit();
  if (visit && pass.code != nullptr) {
    const Visit& made = debugger.file().visits()[*visit];
    ImGui::TextWrapped("t = %s, quality %.4f", format_visit(made).c_str(),
                       static_cast<double>(made.quality));
  }
  if (stack.empty()) return;
  const CodePlace caller = stack.size() > 1 ? place_of(stack.size() - 2) : pass;
  if (caller.code == nullptr) return;
  const std::string_view title = caller.code->title;
  const std::string name(title.substr(0, title.find(':')));
  ImGui::TextDisabled("called from line %u of %s:", caller.line, name.c_str());
  const std::string_view line = caller.code->lines[caller.line - 1];
  const std::string on =
      caller.goes_on > 0 ? fmt::format("; goes on at line {}", caller.goes_on) : "";
  wrapped_text(std::string(line.substr(line.find_first_not_of(' '))) + on);
}

}  // namespace tetmend::viewer::ui
