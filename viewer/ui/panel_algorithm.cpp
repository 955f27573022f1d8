// SPDX-License-Identifier: MIT
// The algorithm of the paper that the call at hand follows, with its line.
#include <string>

#include <imgui.h>

#include "explain/paper_lines.h"
#include "viewer/ui/panels.h"

namespace tetmend::viewer::ui {

namespace {

void show_code(const Pseudocode& code, unsigned line) {
  ImGui::TextWrapped("%s", code.title.data());
  ImDrawList* list = ImGui::GetWindowDrawList();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 1});
  for (unsigned i = 1; i <= code.lines.size(); ++i) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (i == line) {
      list->AddRectFilled(
          {at.x - 2, at.y - 1},
          {at.x + ImGui::GetContentRegionAvail().x, at.y + ImGui::GetTextLineHeight() + 1},
          ImGui::GetColorU32(ImGuiCol_Header), 3);
    }
    ImGui::TextDisabled("%2u", i);
    ImGui::SameLine(2.2F * ImGui::GetFontSize());
    ImGui::TextUnformatted(code.lines[i - 1].data());  // literals
  }
  ImGui::PopStyleVar();
}

}  // namespace

void draw_algorithm_panel(Session& session) {
  const Debugger& debugger = *session.document.debugger();
  const auto& stack = debugger.stack();
  const auto place_of = [&](std::size_t i) {
    return code_place(debugger.file(), stack, i, debugger.position());
  };
  const CodePlace pass = pass_place(debugger.file(), stack, debugger.position());
  const CodePlace here = stack.empty() ? pass : place_of(stack.size() - 1);
  if (here.code == nullptr) {
    ImGui::TextDisabled(stack.empty() ? "no call here" : "an operator that is not described");
    return;
  }
  show_code(*here.code, here.line);
  if (stack.empty()) return;
  const CodePlace caller = stack.size() > 1 ? place_of(stack.size() - 2) : pass;
  if (caller.code == nullptr) return;
  const std::string_view title = caller.code->title;
  const std::string name(title.substr(0, title.find(':')));
  ImGui::TextDisabled("called from line %u of %s:", caller.line, name.c_str());
  ImGui::TextWrapped("%s", caller.code->lines[caller.line - 1].data());
}

}  // namespace tetmend::viewer::ui
