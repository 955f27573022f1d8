// SPDX-License-Identifier: MIT
// The algorithm of the paper that the call at hand follows, with its line.
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// `width` of lines with their numbers. All of it in the size of the text of the current window.
std::vector<CodeLine> wrap_code(const Pseudocode& code, float width) {
  const float room = width - kNumbers * ImGui::GetFontSize();
  std::vector<CodeLine> wrapped;
  for (const std::string_view line : code.lines) wrapped.push_back(code_line(line, room));
  return wrapped;
}

float height_of(const std::vector<CodeLine>& lines) {
  float height = 4 * kGap;
  for (const CodeLine& line : lines) {
    height += static_cast<float>(line.rows()) * ImGui::GetTextLineHeight() + kGap;
  }
  return height;
}

float lines_below(bool is_whole) {
  constexpr float kFew = 3.2F;  // of the caller, where the column is wide
  return is_whole ? kFew : kCallerLines;
}

/// Makes the text of the window so small that no line has breaks, if that is not much; `is_whole`: so
/// small that all is seen.
void fit_text(const Pseudocode& code, bool is_whole) {
  constexpr float kLeast = 0.6F, kLeastUnbroken = 0.66F, kStep = 0.05F;
  constexpr float kTitle = 1;
  const auto fits = [&](float share, bool has_height, bool is_unbroken) {
    ImGui::SetWindowFontScale(share);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float bar = is_whole ? 0 : ImGui::GetStyle().ScrollbarSize;
    const auto lines = wrap_code(code, room.x - bar);
    const bool is_broken = std::any_of(lines.begin(), lines.end(),
                                       [](const CodeLine& line) { return line.rows() > 1; });
    if (is_unbroken && is_broken) return false;
    const std::string title = in_lines(std::string(code.title), room.x);
    const auto breaks = static_cast<float>(std::count(title.begin(), title.end(), '\n'));
    const float around =
        (kTitle + breaks + lines_below(true)) * ImGui::GetTextLineHeightWithSpacing();
    return !has_height || height_of(lines) + around <= room.y;
  };
  for (float share = 1; share > kLeastUnbroken; share -= kStep) {
    if (fits(share, is_whole, true)) return;
  }
  for (float share = 1; share > kLeast; share -= kStep) {
    if (fits(share, is_whole, false)) return;
  }
}

/// `is_new`: the line is to be brought into sight.
void show_code(const Pseudocode& code, unsigned line, bool is_new, bool is_whole) {
  fit_text(code, is_whole);
  wrapped_text(code.title);
  const ImVec2 avail = ImGui::GetContentRegionAvail();
  const float room =
      std::max(avail.y - lines_below(is_whole) * ImGui::GetTextLineHeightWithSpacing(),
               3 * ImGui::GetFontSize());
  std::vector<CodeLine> lines = wrap_code(code, avail.x);
  if (height_of(lines) > room) lines = wrap_code(code, avail.x - ImGui::GetStyle().ScrollbarSize);
  const bool is_higher = height_of(lines) > room;
  // Rounding adds up: what fits is not to be scrolled.
  const float height_of_all = height_of(lines) + static_cast<float>(lines.size());
  ImGui::BeginChild("##lines", {0, std::min(height_of_all, room)}, false,
                    is_higher ? 0 : ImGuiWindowFlags_NoScrollbar);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, kGap});
  ImDrawList* list = ImGui::GetWindowDrawList();
  for (unsigned i = 1; i <= lines.size(); ++i) {
    const CodeLine& shown = lines[i - 1];
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = static_cast<float>(shown.rows()) * ImGui::GetTextLineHeight();
    if (i == line) {
      list->AddRectFilled({at.x - 2, at.y - 1},
                          {at.x + ImGui::GetContentRegionAvail().x, at.y + height + 1},
                          ImGui::GetColorU32(ImGuiCol_Header), 3);
    }
    ImGui::TextDisabled("%2u", i);
    ImGui::SameLine(kNumbers * ImGui::GetFontSize());
    ImGui::BeginGroup();
    show_code_line(shown);
    ImGui::EndGroup();
    if (i == line && is_new && is_higher) ImGui::SetScrollHereY(0.5F);
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

void tell_caller(const CodePlace& caller) {
  const std::string_view title = caller.code->title;
  const std::string name(title.substr(0, title.find(':')));
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  wrapped_text(fmt::format("called from line {} of {}:", caller.line, name));
  ImGui::PopStyleColor();
  const std::string_view line = caller.code->lines[caller.line - 1];
  const std::string on =
      caller.goes_on > 0 ? fmt::format("; goes on at line {}", caller.goes_on) : "";
  wrapped_text(std::string(line.substr(line.find_first_not_of(' '))) + on);
}

/// While tables are filled, Algorithm 2 is at work: at the line that has filled the cell.
void show_filling(Debugger& debugger, const CodePlace& caller, bool is_whole) {
  constexpr unsigned kFills = 13;
  const std::uint64_t place = debugger.position() + 1000 * debugger.tables().filled;
  show_code(table_code(), kFills, is_new_place(place), is_whole);
  if (caller.line > 0) tell_caller(caller);
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

namespace {

void show_algorithm(Session& session, bool is_whole) {
  Debugger& debugger = *session.document.debugger();
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
  if (debugger.tables().here()) return show_filling(debugger, here, is_whole);
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
  tell_caller(caller);
}

}  // namespace

void draw_algorithm_panel(Session& session, bool is_whole) {
  show_algorithm(session, is_whole);
  ImGui::SetWindowFontScale(1);
}

}  // namespace tetmend::viewer::ui
