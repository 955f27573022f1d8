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
#include "viewer/mesh/camera.h"
#include "viewer/mesh/scene.h"

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

/// The surface as it is seen first, flat and lit from the eye.
void StartPage::make_picture() {
  is_made_ = true;
  example_ = find_example();
  if (!example_) return;
  const TetMesh mesh = read_tet_mesh(*example_);
  Camera camera;
  camera.look_from("home");
  const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye());
  const glm::dvec3 up = camera.up();
  const glm::dvec3 right = glm::cross(ahead, up);
  struct Seen {
    double depth;
    glm::dvec2 corners[3];
    double light;
  };
  std::vector<Seen> seen;
  glm::dvec2 low(1e300);
  glm::dvec2 high(-1e300);
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(TetHandle(i), f);
      if (mesh.is_deleted(face.tet()) || !mesh.is_boundary(face)) continue;
      const auto c = viewer::corners(mesh, face);
      const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
      const double light = std::abs(glm::dot(normal, ahead));
      Seen triangle{-glm::dot(c[0] + c[1] + c[2], ahead), {}, light};
      for (int k = 0; k < 3; ++k) {
        triangle.corners[k] = {glm::dot(c[static_cast<std::size_t>(k)], right),
                               -glm::dot(c[static_cast<std::size_t>(k)], up)};
        low = glm::min(low, triangle.corners[k]);
        high = glm::max(high, triangle.corners[k]);
      }
      seen.push_back(triangle);
    }
  }
  std::sort(seen.begin(), seen.end(),
            [](const Seen& a, const Seen& b) { return a.depth < b.depth; });
  const double size = std::max(high.x - low.x, high.y - low.y);
  for (const Seen& triangle : seen) {
    Triangle drawn{};
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2 at =
          (triangle.corners[k] - (low + high) / 2.0) / std::max(size, 1e-300) + 0.5;
      drawn.corners[k] = {static_cast<float>(at.x), static_cast<float>(at.y)};
    }
    const auto shade = static_cast<float>(0.35 + 0.6 * triangle.light);
    drawn.colour = ImGui::GetColorU32({0.72F * shade, 0.80F * shade, 0.92F * shade, 1});
    picture_.push_back(drawn);
  }
}

void StartPage::draw_picture(float width, float height) const {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float size = std::min(width, height);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImDrawListFlags flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;  // no seams between triangles
  for (const Triangle& triangle : picture_) {
    ImVec2 at[3];
    for (int k = 0; k < 3; ++k) {
      at[k] = {corner.x + width / 2 + (triangle.corners[k].x - 0.5F) * size,
               corner.y + height / 2 + (triangle.corners[k].y - 0.5F) * size};
    }
    list.AddTriangleFilled(at[0], at[1], at[2], triangle.colour);
  }
  list.Flags = flags;
  ImGui::Dummy({width, height});
}

Choice StartPage::draw_cards(float width) {
  Choice choice;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 card = {(width - gap) / 2, 3.2F * ImGui::GetFontSize()};
  if (ImGui::Button("Open a file ...\nCtrl+O, or drop it here", card)) {
    choice.command = &find_command("open");
  }
  ImGui::SameLine();
  if (example_ && ImGui::Button("Example\nthe bracket, with its bad tets", card)) {
    choice = {&find_command("open"), {example_->string()}};
  }
  return choice;
}

Choice StartPage::draw_lists(const Document& document) {
  ImGui::Spacing();
  ImGui::TextDisabled("Lessons: traces with a text that leads through them");
  Choice choice = list_lessons([](const char* title) { return ImGui::Selectable(title); });
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

Choice StartPage::draw(const Document& document, float scale) {
  constexpr float kWidth = 640;
  constexpr float kLeastForPicture = 620;
  constexpr float kPictureHeight = 180;
  if (!is_made_) {
    try {
      make_picture();
    } catch (const std::exception&) {
      picture_.clear();  // a page without a picture is good enough
    }
  }
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float width = std::min(kWidth * scale, window.x);
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, 0.92F * window.y});
  ImGui::Begin("##start", nullptr, kPage | ImGuiWindowFlags_AlwaysAutoResize);
  const float inside = ImGui::GetContentRegionAvail().x;
  ImGui::SetWindowFontScale(1.6F);
  ImGui::Text("tetmend %s", std::string(program_version()).c_str());
  ImGui::SetWindowFontScale(1);
  ImGui::TextDisabled("tetrahedral meshes, their bad tets, and runs that mend them");
  if (!picture_.empty() && window.y >= kLeastForPicture * scale) {
    draw_picture(inside, kPictureHeight * scale);
  }
  Choice choice = draw_cards(inside);
  Choice listed = draw_lists(document);
  if (listed.command != nullptr) choice = std::move(listed);
  ImGui::End();
  return choice;
}

}  // namespace tetmend::viewer::ui
