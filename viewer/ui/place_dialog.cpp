// SPDX-License-Identifier: MIT
#include "viewer/ui/place_dialog.h"

#include <utility>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/ui/dialog_buttons.h"

namespace tetmend::viewer::ui {

void PlaceDialog::draw(Session& session) {
  constexpr const char* kPopup = "##place";
  Document& document = session.document;
  if (document.ask_place) {
    document.ask_place = false;
    trouble_.clear();
    typed_.clear();
    wants_focus_ = true;
    ImGui::OpenPopup(kPopup);
  }
  ImGui::SetNextWindowSize({24 * ImGui::GetFontSize(), 0});
  if (!ImGui::BeginPopupModal(kPopup, nullptr,
                              ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoTitleBar)) {
    return;
  }
  ImGui::TextUnformatted("Go to");
  if (std::exchange(wants_focus_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool is_entered =
      ImGui::InputTextWithHint("##where", "tet 17, edge 3 17 or vertex 5, from 0", &typed_,
                               ImGuiInputTextFlags_EnterReturnsTrue);
  const Answer answer = dialog_buttons("Go", is_entered, trouble_);
  if (answer == Answer::cancelled) {
    ImGui::CloseCurrentPopup();
  } else if (answer == Answer::accepted && !typed_.empty()) {
    trouble_.clear();
    if (guarded(document, [&] { find_command("go_to").run(session, {typed_}); })) {
      ImGui::CloseCurrentPopup();
    } else {
      trouble_ = document.message.text;
      wants_focus_ = true;
    }
  }
  ImGui::EndPopup();
}

}  // namespace tetmend::viewer::ui
