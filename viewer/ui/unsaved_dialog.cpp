// SPDX-License-Identifier: MIT
#include "viewer/ui/unsaved_dialog.h"

#include <filesystem>

#include <imgui.h>

#include "viewer/ui/dialog_buttons.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

/// The dialog for files is closed again: it was saved, or the user does not want to after all.
void go_on_after_saving(Session& session) {
  if (session.document.has_unsaved()) {
    session.document.waiting.reset();
  } else {
    do_soon(session, [&session] { run_waiting(session); });
  }
}

void ask(Session& session) {
  Document& document = session.document;
  const bool is_at_work = document.live.is_active();
  const std::string name = std::filesystem::path(document.file()).filename().string();
  wrapped_text(is_at_work
                   ? "A run is at work on " + name + ": this ends it, and what it has done is lost."
                   : name + " was changed, and is not saved.");
  if (!is_at_work && (ImGui::Button("Save ... (S)") || ImGui::IsKeyPressed('S'))) {
    document.waiting->is_saving = true;
    document.question = FileQuestion::save;
    ImGui::CloseCurrentPopup();
    return;
  }
  if (!is_at_work) ImGui::SameLine();
  // Letters have the numbers of their characters as keys, too.
  const Answer answer = dialog_buttons(is_at_work ? "End the run (D)" : "Do not save (D)",
                                       ImGui::IsKeyPressed('D'), "");
  if (answer == Answer::none) return;
  ImGui::CloseCurrentPopup();
  if (answer == Answer::accepted) {
    do_soon(session, [&session] { run_waiting(session); });
  } else {
    document.waiting.reset();
  }
}

}  // namespace

void UnsavedDialog::draw(Session& session) {
  constexpr const char* kPopup = "##unsaved";
  Document& document = session.document;
  if (!document.waiting) return;
  const bool is_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
  if (document.waiting->is_saving) {
    if (!is_open && document.question == FileQuestion::none) go_on_after_saving(session);
    return;
  }
  if (!is_open) ImGui::OpenPopup(kPopup);
  ImGui::SetNextWindowSize({26 * ImGui::GetFontSize(), 0});
  if (!ImGui::BeginPopupModal(kPopup, nullptr,
                              ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoTitleBar)) {
    return;
  }
  ask(session);
  ImGui::EndPopup();
}

}  // namespace tetmend::viewer::ui
