// SPDX-License-Identifier: MIT
#include "viewer/ui/start_page.h"

#include <algorithm>
#include <exception>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "explain/lesson_guide.h"
#include "kernel/formats/tet_mesh_io.h"
#include "kernel/tet_mesh.h"
#include "viewer/live/program_version.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

constexpr ImGuiWindowFlags kPage = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar |
                                   ImGuiWindowFlags_NoBringToFrontOnFocus;

std::optional<std::filesystem::path> find_example() {
  const auto lessons = explain::find_lessons();
  if (lessons.empty()) return std::nullopt;
  const auto file = lessons.front().parent_path() / "../meshes/bracket.meshb";
  std::error_code none;
  if (!std::filesystem::exists(file, none)) return std::nullopt;
  return file.lexically_normal();
}

}  // namespace

Choice list_lessons(bool (*entry)(const char* title)) {
  Choice choice;
  const auto lessons = explain::find_lessons();
  if (lessons.empty()) ImGui::TextDisabled("there are none here");
  for (const auto& file : lessons) {
    try {
      const Lesson lesson = read_lesson(file);
      if (entry(lesson.title.c_str())) choice = {&find_command("open"), {lesson.trace.string()}};
    } catch (const std::exception& error) {
      ImGui::TextDisabled("%s", error.what());
    }
  }
  return choice;
}

void StartPage::make_pictures() {
  is_made_ = true;
  example_ = find_example();
  const auto carefully = [](const auto& make) {
    try {
      make();
    } catch (const std::exception&) {
      // a page without a picture is good enough
    }
  };
  if (example_) {
    carefully([&] { picture_ = MeshPicture(read_tet_mesh(*example_), MeshPicture::Look::solid); });
  }
  for (const auto& file : explain::find_lessons()) {
    carefully([&] {
      const Lesson lesson = read_lesson(file);
      lessons_.push_back({lesson.title, lesson.trace.string(), {}});
      if (lesson.mesh.empty()) return;
      const TetMesh mesh = read_tet_mesh(lesson.mesh);
      lessons_.back().picture = MeshPicture(mesh, MeshPicture::Look::glass);
    });
  }
}

Choice StartPage::draw_cards(float width) {
  Choice choice;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 card = {(width - gap) / 2, 3 * ImGui::GetFontSize()};
  if (ImGui::Button("Open a file ...\nCtrl+O, or drop it here", card)) {
    choice.command = &find_command("open");
  }
  ImGui::SameLine();
  if (example_ && ImGui::Button("Example\nthe bracket, with its bad tets", card)) {
    choice = {&find_command("open"), {example_->string()}};
  }
  return choice;
}

/// A card: the mesh it begins with, and its title.
bool StartPage::draw_lesson(const LessonCard& lesson, const ImVec2& size) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const bool is_chosen = ImGui::Button("##lesson", size);
  const float pad = ImGui::GetStyle().FramePadding.y;
  const float side = size.y - 2 * pad;
  lesson.picture.draw({corner.x + pad, corner.y + pad}, {side, side});
  const float left = corner.x + side + 3 * pad;
  const float room = size.x - side - 4 * pad;
  const std::string title = in_lines(lesson.title, room);
  const float height = ImGui::CalcTextSize(title.c_str()).y;
  draw_indexed(*ImGui::GetWindowDrawList(), {left, corner.y + std::max(pad, (size.y - height) / 2)},
               ImGui::GetColorU32(ImGuiCol_Text), title);
  return is_chosen;
}

Choice StartPage::draw_lessons(float width) {
  constexpr int kInRow = 2;
  Choice choice;
  if (lessons_.empty()) return choice;
  ImGui::Spacing();
  ImGui::TextDisabled("Lessons: recorded runs with a text that leads through them");
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 card = {(width - (kInRow - 1) * gap) / kInRow, 3 * ImGui::GetFontSize()};
  for (std::size_t i = 0; i < lessons_.size(); ++i) {
    if (i % kInRow != 0) ImGui::SameLine();
    ImGui::PushID(static_cast<int>(i));
    if (draw_lesson(lessons_[i], card)) choice = {&find_command("open"), {lessons_[i].trace}};
    ImGui::PopID();
  }
  return choice;
}

Choice StartPage::draw_recent(const Document& document) {
  Choice choice;
  if (document.recent.empty()) return choice;
  ImGui::Spacing();
  ImGui::TextDisabled("Opened lately");
  for (const std::string& file : document.recent) {
    const std::string name = std::filesystem::path(file).filename().string();
    ImGui::PushID(file.c_str());
    if (ImGui::Selectable(name.c_str())) choice = {&find_command("open"), {file}};
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", file.c_str());
    ImGui::PopID();
  }
  return choice;
}

Choice StartPage::draw(const Document& document, float scale, ImFont* large) {
  constexpr float kWidth = 640;
  constexpr float kLeastForPicture = 620;
  constexpr float kPictureHeight = 160;
  if (!is_made_) make_pictures();
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float width = std::min(kWidth * scale, window.x);
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, 0.92F * window.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin("##start", nullptr, kPage | ImGuiWindowFlags_AlwaysAutoResize);
  const float inside = ImGui::GetContentRegionAvail().x;
  ImGui::PushFont(large);
  ImGui::Text("tetmend %s", std::string(program_version()).c_str());
  ImGui::PopFont();
  ImGui::TextDisabled("tetrahedral meshes, their bad tets, and runs that mend them");
  if (!picture_.is_empty() && window.y >= kLeastForPicture * scale) {
    const ImVec2 size = {inside, kPictureHeight * scale};
    picture_.draw(ImGui::GetCursorScreenPos(), size);
    ImGui::Dummy(size);
  }
  Choice choice = draw_cards(inside);
  for (Choice listed : {draw_lessons(inside), draw_recent(document)}) {
    if (listed.command != nullptr) choice = std::move(listed);
  }
  ImGui::End();
  ImGui::PopStyleVar();
  return choice;
}

}  // namespace tetmend::viewer::ui
