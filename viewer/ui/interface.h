// SPDX-License-Identifier: MIT
// Menus, panels and status line around the picture, with Dear ImGui; knows no window.
#pragma once

#include <string>

#include "viewer/commands/commands.h"
#include "viewer/ui/file_browser.h"

namespace tetmend::viewer::ui {

/// Needs a current OpenGL context for its whole life. There can be one at a time.
class Interface {
 public:
  /// `scale`: 1 for an ordinary screen, 2 for one with twice as many pixels in the same place.
  explicit Interface(float scale);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Gives the document the part of the window that the panels leave.
  void arrange(Document& document) const;
  /// Everything but the mesh. Between begin_frame() of whoever feeds events and draw().
  void build(Session& session);
  /// Draws what build() has laid out into the current framebuffer.
  void draw() const;
  float scale() const { return scale_; }

 private:
  void strip(Session& session) const;
  void sides(Session& session) const;
  void status_line(Session& session) const;
  void keys_page(Session& session) const;
  void apply_theme(const std::string& theme);

  float scale_;
  std::string theme_;
  FileBrowser browser_;
};

}  // namespace tetmend::viewer::ui
