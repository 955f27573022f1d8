// SPDX-License-Identifier: MIT
#include "viewer/ui/file_browser.h"

#include <exception>
#include <system_error>
#include <utility>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "explain/lesson_guide.h"
#include "kernel/formats/mesh_io.h"
#include "viewer/ui/dialog_buttons.h"

namespace tetmend::viewer::ui {

namespace {

constexpr const char* kPopup = "##file";

const char* title_of(FileQuestion question) {
  if (question == FileQuestion::save) return "Save the mesh as";
  if (question == FileQuestion::reference) return "Open a mesh whose surface to compare with";
  return question == FileQuestion::schedule ? "Choose a schedule" : "Open a mesh or a trace";
}

std::vector<std::string_view> extensions_of(FileQuestion question) {
  if (question == FileQuestion::schedule) return {".lua"};
  std::vector<std::string_view> extensions;
  for (const MeshFormat& format : mesh_formats()) extensions.push_back(format.extension);
  if (question == FileQuestion::open) extensions.emplace_back(".trace");
  return extensions;
}

/// Of the file that is open, or the current one.
std::filesystem::path folder_of(const std::string& file) {
  std::error_code trouble;
  const auto here = std::filesystem::current_path(trouble);
  const auto folder = file.empty() ? here : (here / file).parent_path();
  return folder.empty() ? std::filesystem::path("/") : folder;
}

}  // namespace

void FileBrowser::begin(const Document& document) {
  question_ = document.question;
  wants_focus_ = true;
  trouble_.clear();
  typed_.clear();
  if (folder_.empty()) folder_ = folder_of(document.file());
  go_to(folder_);
}

void FileBrowser::go_to(const std::filesystem::path& folder) {
  try {
    const auto extensions = extensions_of(question_);
    entries_ = list_folder(folder, extensions);
    folder_ = folder.lexically_normal();
    trouble_.clear();
  } catch (const std::exception& error) {
    trouble_ = error.what();
  }
}

void FileBrowser::list(float scale) {
  constexpr float kHeight = 320;
  ImGui::BeginChild("##entries", {0, kHeight * scale}, true);
  std::filesystem::path next;
  if (ImGui::Selectable("../", false, ImGuiSelectableFlags_DontClosePopups)) {
    next = folder_.parent_path();
  }
  for (const FileEntry& entry : entries_) {
    const std::string shown = entry.is_folder ? entry.name + "/" : entry.name;
    constexpr ImGuiSelectableFlags kFlags =
        ImGuiSelectableFlags_DontClosePopups | ImGuiSelectableFlags_AllowDoubleClick;
    if (ImGui::Selectable(shown.c_str(), typed_ == entry.name, kFlags)) {
      if (entry.is_folder) {
        next = folder_ / entry.name;
      } else {
        typed_ = entry.name;
        is_accepted_ = ImGui::IsMouseDoubleClicked(0);
      }
    }
    if (entry.is_folder) continue;
    const std::string size = format_bytes(entry.bytes);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(size.c_str()).x);
    ImGui::TextDisabled("%s", size.c_str());
  }
  ImGui::EndChild();
  if (!next.empty()) go_to(next);
}

/// They are traces in a folder of their own.
void FileBrowser::offer_lessons() {
  const auto lessons = find_lessons();
  if (lessons.empty()) return;
  const float width = ImGui::CalcTextSize("lessons").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
  if (ImGui::SmallButton("lessons")) go_to(folder_of(lessons.front().string()));
}

/// The dialog stays when that does not work.
void FileBrowser::finish(Session& session) {
  wants_focus_ = true;
  try {
    const std::filesystem::path file = chosen();
    if (std::error_code none; std::filesystem::is_directory(file, none)) {
      typed_.clear();
      return go_to(file);
    }
    if (question_ == FileQuestion::open) session.document.open(file);
    if (question_ == FileQuestion::save) session.document.save(file);
    if (question_ == FileQuestion::reference) {
      find_command("reference").run(session, {file.string()});
    }
    if (question_ == FileQuestion::schedule) session.document.live.choose_schedule(file.string());
    folder_ = folder_of(file.string());
    ImGui::CloseCurrentPopup();
  } catch (const std::exception& error) {
    trouble_ = error.what();
  }
}

void FileBrowser::draw(Session& session, float scale) {
  constexpr float kWidth = 600;
  if (session.document.question != FileQuestion::none) {
    begin(session.document);
    session.document.question = FileQuestion::none;
    ImGui::OpenPopup(kPopup);
  }
  ImGui::SetNextWindowSize({kWidth * scale, 0});
  if (!ImGui::BeginPopupModal(kPopup, nullptr,
                              ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoTitleBar)) {
    return;
  }
  ImGui::TextUnformatted(title_of(question_));
  ImGui::TextDisabled("%s", folder_.string().c_str());
  if (question_ == FileQuestion::open) offer_lessons();
  is_accepted_ = false;
  list(scale);
  if (std::exchange(wants_focus_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  if (ImGui::InputTextWithHint("##name", "name, or a path", &typed_,
                               ImGuiInputTextFlags_EnterReturnsTrue)) {
    is_accepted_ = true;
  }
  std::error_code none;
  const bool replaces = question_ == FileQuestion::save && !typed_.empty() &&
                        std::filesystem::is_regular_file(chosen(), none);
  const char* accept = replaces                          ? "Replace the file"
                       : question_ == FileQuestion::save ? "Save"
                                                         : "Open";
  const Answer answer = dialog_buttons(accept, is_accepted_, trouble_);
  if (answer == Answer::cancelled) {
    ImGui::CloseCurrentPopup();
  } else if (answer == Answer::accepted && !typed_.empty()) {
    finish(session);
  }
  ImGui::EndPopup();
}

}  // namespace tetmend::viewer::ui
