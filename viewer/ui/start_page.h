// SPDX-License-Identifier: MIT
// What the window shows while nothing is open: name, picture, what to open.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>
#include <nlohmann/json.hpp>

#include "viewer/commands/commands.h"
#include "viewer/ui/mesh_picture.h"

namespace tetmend::viewer::ui {

/// Of a menu or a card. Runs when the layout is complete: it may take a picture.
struct Choice {
  const Command* command = nullptr;  ///< nothing was chosen
  nlohmann::json arguments = nlohmann::json::array();
};

/// An entry for each lesson; `entry` draws it and tells whether it was clicked.
Choice list_lessons(bool (*entry)(const char* title));

class StartPage {
 public:
  /// @param large font of the title
  Choice draw(const Document& document, float scale, ImFont* large);

 private:
  struct LessonCard {
    std::string title;
    std::string trace;
    MeshPicture picture;  // of the mesh that it begins with
  };
  void make_pictures();
  static bool draw_lesson(const LessonCard& lesson, const ImVec2& size);
  Choice draw_cards(float width);
  Choice draw_lessons(float width);
  static Choice draw_recent(const Document& document);

  bool is_made_ = false;
  std::optional<std::filesystem::path> example_;  // a mesh that tetmend brings along
  MeshPicture picture_;                           // of it
  std::vector<LessonCard> lessons_;
};

}  // namespace tetmend::viewer::ui
