// SPDX-License-Identifier: MIT
// What the window shows while nothing is open: name, picture, what to open.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <imgui.h>
#include <nlohmann/json.hpp>

#include "viewer/commands/commands.h"

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
  Choice draw(const Document& document, float scale);

 private:
  struct Triangle {
    ImVec2 corners[3];  // 0 to 1
    ImU32 colour;
  };
  void make_picture();
  void draw_picture(float width, float height) const;
  Choice draw_cards(float width);
  Choice draw_lists(const Document& document);

  bool is_made_ = false;
  std::optional<std::filesystem::path> example_;  // a mesh that tetmend brings along
  std::vector<Triangle> picture_;                 // of it, the farthest first
};

}  // namespace tetmend::viewer::ui
