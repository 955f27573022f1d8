// SPDX-License-Identifier: MIT
#include "viewer/ui/keys_page.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>
#include <vector>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/ui/dialog_buttons.h"

namespace tetmend::viewer::ui {

namespace {

using KeyRow = std::pair<std::string, std::string>;  // keys, effect

bool has_word(const KeyRow& row, const std::string& typed) {
  const std::string text = row.first + " " + row.second;
  return std::search(text.begin(), text.end(), typed.begin(), typed.end(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) ==
                  std::tolower(static_cast<unsigned char>(b));
         }) != text.end();
}

std::vector<KeyRow> rows_of(std::string_view menu) {
  std::vector<KeyRow> rows;
  if (menu == "Mouse") {
    for (const auto& gesture : mouse_gestures()) rows.emplace_back(gesture.first, gesture.second);
  }
  for (const Command& command : commands()) {
    if (command.menu == menu && !command.keys.empty()) {
      rows.emplace_back(command.keys, command.help);
    }
  }
  return rows;
}

/// Those with the typed word; nothing is drawn without any.
void show_group(const char* title, const std::string& typed) {
  std::vector<KeyRow> rows = rows_of(title);
  std::erase_if(rows, [&](const KeyRow& row) { return !has_word(row, typed); });
  if (rows.empty()) return;
  ImGui::Spacing();
  ImGui::TextDisabled("%s", title);
  if (!ImGui::BeginTable(title, 2, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.3F);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.7F);
  for (const auto& [keys, effect] : rows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", keys.c_str());
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", effect.c_str());
  }
  ImGui::EndTable();
}

}  // namespace

void KeysPage::draw(Session& session, float scale) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(window.x, 760 * scale), std::min(window.y, 640 * scale)});
  ImGui::Begin("Keys (F1 closes)", &session.document.show_keys,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::IsWindowAppearing()) {
    typed_.clear();
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::InputTextWithHint("##search", "search: a word or a key", &typed_);
  if (ImGui::IsItemDeactivated() && is_escape()) {
    session.document.show_keys = false;
  }
  const bool has_trace = session.document.debugger() != nullptr;
  if (ImGui::BeginChild("##groups")) {
    for (const char* title : {"Mouse", "File", "View", "Show", "Select", "Run", "Help"}) {
      show_group(title, typed_);
    }
    // Of use in a trace alone.
    if (has_trace || !typed_.empty()) {
      show_group("Trace", typed_);
    } else {
      ImGui::TextDisabled("Trace: keys appear here once one is open");
    }
  }
  ImGui::EndChild();
  ImGui::End();
}

}  // namespace tetmend::viewer::ui
