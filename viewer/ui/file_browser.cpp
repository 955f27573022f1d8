// SPDX-License-Identifier: MIT
#include "viewer/ui/file_browser.h"

#include <algorithm>
#include <cctype>
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
  if (question == FileQuestion::other_run) return "Open a trace to compare this run with";
  return question == FileQuestion::schedule ? "Choose a schedule" : "Open a mesh or a trace";
}

std::vector<std::string_view> extensions_of(FileQuestion question) {
  if (question == FileQuestion::schedule) return {".lua"};
  if (question == FileQuestion::other_run) return {".trace"};
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

/// At once, unless unsaved work would be lost. @throws Error as Document::open().
void open(Session& session, const std::filesystem::path& file) {
  const Command& command = find_command("open");
  if (session.document.has_unsaved()) return run_from_window(command, session, {file.string()});
  command.run(session, {file.string()});
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
    marked_.clear();
    folder_ = folder.lexically_normal();
    trouble_.clear();
  } catch (const std::exception& error) {
    trouble_ = error.what();
  }
}

/// A name is typed for a file that may be new: then nothing is filtered.
bool FileBrowser::is_listed(const FileEntry& entry) const {
  if (typed_.empty() || question_ == FileQuestion::save) return true;
  const auto are_alike = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(entry.name.begin(), entry.name.end(), typed_.begin(), typed_.end(),
                     are_alike) != entry.name.end();
}

/// Down or up in what is listed.
void FileBrowser::mark_next(int step) {
  std::vector<std::string> names;
  for (const FileEntry& entry : entries_) {
    if (is_listed(entry)) names.push_back(entry.name);
  }
  if (names.empty()) return;
  const auto now = std::find(names.begin(), names.end(), marked_);
  const auto last = static_cast<std::ptrdiff_t>(names.size()) - 1;
  const std::ptrdiff_t place =
      now == names.end() ? (step > 0 ? 0 : last)
                         : std::clamp<std::ptrdiff_t>(now - names.begin() + step, 0, last);
  marked_ = names[static_cast<std::size_t>(place)];
  is_moved_ = true;
}

/// What was typed, if there is such a file or if it is to be made; else the entry that is marked, or
/// the only one that is listed.
std::filesystem::path FileBrowser::named() const {
  std::error_code none;
  const std::filesystem::path typed = folder_ / typed_;
  const bool is_there = !typed_.empty() && std::filesystem::exists(typed, none);
  if (question_ == FileQuestion::save || is_there) return typed;
  const auto listed = [&](const FileEntry& entry) { return is_listed(entry); };
  const auto marked = std::find_if(entries_.begin(), entries_.end(), [&](const FileEntry& entry) {
    return entry.name == marked_ && is_listed(entry);
  });
  if (marked != entries_.end()) return folder_ / marked->name;
  if (typed_.empty() || std::count_if(entries_.begin(), entries_.end(), listed) != 1) return typed;
  return folder_ / std::find_if(entries_.begin(), entries_.end(), listed)->name;
}

void FileBrowser::list(float scale) {
  constexpr float kHeight = 320;
  constexpr float kOthers = 7;  // lines of the dialog above and below
  const float room = ImGui::GetIO().DisplaySize.y - kOthers * ImGui::GetFrameHeightWithSpacing();
  const float least = 2 * ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("##entries", {0, std::clamp(room, least, kHeight * scale)}, true);
  std::filesystem::path next;
  if (ImGui::Selectable("../", false, ImGuiSelectableFlags_DontClosePopups)) {
    next = folder_.parent_path();
  }
  for (const FileEntry& entry : entries_) {
    if (!is_listed(entry)) continue;
    const std::string shown = entry.is_folder ? entry.name + "/" : entry.name;
    constexpr ImGuiSelectableFlags kFlags =
        ImGuiSelectableFlags_DontClosePopups | ImGuiSelectableFlags_AllowDoubleClick;
    const bool is_marked = marked_ == entry.name || typed_ == entry.name;
    const bool is_clicked = ImGui::Selectable(shown.c_str(), is_marked, kFlags);
    if (marked_ == entry.name && is_moved_) ImGui::SetScrollHereY();
    if (is_clicked) {
      if (entry.is_folder) {
        next = folder_ / entry.name;
      } else {
        marked_ = entry.name;
        if (question_ == FileQuestion::save) typed_ = entry.name;
        is_accepted_ = ImGui::IsMouseDoubleClicked(0);
      }
    }
    if (entry.is_folder) continue;
    const std::string size = format_bytes(entry.bytes);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(size.c_str()).x);
    ImGui::TextDisabled("%s", size.c_str());
  }
  is_moved_ = false;
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
    const std::filesystem::path file = named();
    if (std::error_code none; std::filesystem::is_directory(file, none)) {
      typed_.clear();
      return go_to(file);
    }
    if (question_ == FileQuestion::open) open(session, file);
    if (question_ == FileQuestion::save) session.document.save(file);
    if (question_ == FileQuestion::reference) {
      find_command("reference").run(session, {file.string()});
    }
    if (question_ == FileQuestion::other_run) {
      find_command("against").run(session, {file.string()});
    }
    if (question_ == FileQuestion::schedule) session.document.live.choose_schedule(file.string());
    folder_ = folder_of(file.string());
    is_done_ = true;
  } catch (const std::exception& error) {
    trouble_ = error.what();
  }
}

/// The field for the name; the arrows are for the list.
void FileBrowser::ask_name() {
  if (std::exchange(wants_focus_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const char* hint =
      question_ == FileQuestion::save ? "name, or a path" : "a part of a name, or a path";
  const auto arrow = [](ImGuiInputTextCallbackData* data) {
    static_cast<FileBrowser*>(data->UserData)
        ->mark_next(data->EventKey == ImGuiKey_DownArrow ? 1 : -1);
    return 0;
  };
  if (ImGui::InputTextWithHint(
          "##name", hint, &typed_,
          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackHistory, arrow,
          this)) {
    is_accepted_ = true;
  }
}

void FileBrowser::draw(Session& session, float scale) {
  constexpr float kWidth = 600;
  if (session.document.question != FileQuestion::none) {
    begin(session.document);
    session.document.question = FileQuestion::none;
    ImGui::OpenPopup(kPopup);
  }
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(kWidth * scale, window.x), 0});
  if (!ImGui::BeginPopupModal(
          kPopup, nullptr,
          ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove)) {
    return;
  }
  if (std::exchange(is_done_, false)) {
    ImGui::CloseCurrentPopup();
    return ImGui::EndPopup();
  }
  ImGui::TextUnformatted(title_of(question_));
  ImGui::TextDisabled("%s", folder_.string().c_str());
  if (question_ == FileQuestion::open) offer_lessons();
  is_accepted_ = false;
  list(scale);
  ask_name();
  std::error_code none;
  const bool replaces = question_ == FileQuestion::save && !typed_.empty() &&
                        std::filesystem::is_regular_file(named(), none);
  const char* accept = replaces                          ? "Replace the file"
                       : question_ == FileQuestion::save ? "Save"
                                                         : "Open";
  const Answer answer = dialog_buttons(accept, is_accepted_, trouble_);
  if (answer == Answer::cancelled) {
    ImGui::CloseCurrentPopup();
  } else if (answer == Answer::accepted && !(typed_.empty() && marked_.empty())) {
    do_soon(session, [this, &session] { finish(session); });
  }
  ImGui::EndPopup();
}

}  // namespace tetmend::viewer::ui
