// SPDX-License-Identifier: MIT
// What mouse and keys over the picture do: no window, no graphics library.
#pragma once

#include <filesystem>
#include <string_view>

#include "viewer/commands/commands.h"

namespace tetmend::viewer {

enum class Button { left, middle, right };

/// Turns events into changes of the document. Places are pixels of the window; times are in
/// seconds. Errors become the message of the document.
class Controller {
 public:
  explicit Controller(Session& session) : session_(session) {}

  void press(Button button, double x, double y, bool shift);
  void move(double x, double y);
  /// A press and a release at the same place are a click: it picks. Two soon after each other also
  /// fit what was picked.
  void release(double x, double y, double time);
  void scroll(double steps, double x, double y);
  /// Keys as in Command::keys. Unknown ones do nothing.
  void key(std::string_view keys);
  /// A mesh, or a view as a .json file.
  void drop(const std::filesystem::path& file);

 private:
  enum class Drag { nothing, orbit, pan };

  void click(double x, double y, double time);
  void ask(double x, double y);

  Session& session_;
  Drag drag_ = Drag::nothing;
  Button button_ = Button::left;
  bool moved_ = false;
  glm::dvec2 pressed_{0};
  glm::dvec2 last_{0};
  double last_click_ = -1e9;
};

}  // namespace tetmend::viewer
