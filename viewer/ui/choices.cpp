// SPDX-License-Identifier: MIT
#include "viewer/ui/choices.h"

#include <fmt/format.h>
#include <imgui.h>

#include "kernel/spaced.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/dialog_buttons.h"

namespace tetmend::viewer::ui {

namespace {

bool entry(const std::string& text, bool is_possible = true) {
  return ImGui::MenuItem(text.c_str(), nullptr, false, is_possible);
}

/// The operators for a target of so many vertices; a click tries one there.
void offer_trials(Session& session, const std::vector<VertexHandle>& part) {
  if (!begin_submenu("Try ...")) return;
  for (const OperatorInfo* info : session.document.live.registry().operators()) {
    if (vertices_of(info->target) != part.size()) continue;
    const std::string name(info->name);
    if (entry(spaced(name))) {
      do_soon(session, [&d = session.document, name, part] { d.try_operator({name, part, {}}); });
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(info->help).c_str());
  }
  ImGui::EndMenu();
}

}  // namespace

void Choices::draw(Session& session) {
  constexpr const char* kMenu = "##choices";
  constexpr ImGuiMouseButton kRight = 1;
  Document& document = session.document;
  const bool is_on_panel = ImGui::GetIO().WantCaptureMouse && ImGui::IsMouseClicked(kRight) &&
                           !document.hovering.is_nothing();
  if (document.offer_choices || is_on_panel) {
    subject_ = document.offer_choices ? document.pointed_selection(document.selection())
                                      : document.hovering;
    ImGui::OpenPopup(kMenu);
  }
  document.offer_choices = false;
  if (!ImGui::BeginPopup(kMenu)) return;
  close_by_escape();
  offer(session);
  ImGui::EndPopup();
}

void Choices::offer(Session& session) const {
  Document& document = session.document;
  const bool has_trace = document.debugger() != nullptr;
  if (has_trace && subject_.call != kNoCall) {
    if (entry(fmt::format("Go to call {}", subject_.call))) {
      run_from_window(find_command("enter"), session, {subject_.call});
    }
  }
  const auto& part = subject_.vertices;
  if (part.empty() || part.size() > 4) return;
  const std::string kind(kind_of(part));
  ImGui::TextDisabled("%s", in_words(part).c_str());
  const Selection selection = document.selection_of(part);
  const bool is_there = !std::holds_alternative<std::monostate>(selection);
  if (entry(is_there ? "Go to this " + kind : "Go to this " + kind + ": it is not there",
            is_there)) {
    guarded(document, [&] { document.fly_to(selection); });
  }
  if (is_there) offer_trials(session, part);
  const bool is_of_run = has_trace && document.trial() == nullptr;
  if (is_of_run && entry("History of this " + kind)) {
    run_from_window(find_command("history"), session, {as_question(part)});
  }
}

}  // namespace tetmend::viewer::ui
