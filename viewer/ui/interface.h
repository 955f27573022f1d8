// SPDX-License-Identifier: MIT
// Menus, panels and status line around the picture, with Dear ImGui; knows no window.
#pragma once

#include <string>

#include "viewer/commands/commands.h"
#include "viewer/ui/choices.h"
#include "viewer/ui/file_browser.h"
#include "viewer/ui/keys_page.h"
#include "viewer/ui/layout.h"
#include "viewer/ui/place_dialog.h"
#include "viewer/ui/start_page.h"
#include "viewer/ui/unsaved_dialog.h"

struct ImFont;

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
  /// Everything but the mesh. Between begin_frame() of whoever feeds events and draw(). What goes
  /// wrong in a panel becomes the message of the document.
  void build(Session& session);
  /// Draws what build() has laid out into the current framebuffer.
  void draw() const;
  float scale() const { return scale_; }

 private:
  void panels_around(Session& session, const Layout& layout);
  void apply_theme(const std::string& theme);

  float scale_;
  std::string theme_;
  ImFont* large_ = nullptr;  // for teaching
  FileBrowser browser_;
  PlaceDialog place_dialog_;
  Choices choices_;
  KeysPage keys_page_;
  StartPage start_page_;
  bool was_in_call_ = false;  // in the last layout
  UnsavedDialog unsaved_dialog_;
};

}  // namespace tetmend::viewer::ui
