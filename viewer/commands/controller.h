// SPDX-License-Identifier: MIT
// What mouse and keys over the picture do: no window, no graphics library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
  /// The same, of a key that is a letter. Several soon after each other look like a word that was meant
  /// for a box: then the user is offered to take back what they did.
  void letter(char letter, std::string_view keys, double time);
  /// A mesh, or a view as a .json file.
  void drop(const std::filesystem::path& file);

 private:
  enum class Drag { nothing, orbit, pan };

  /// Letters that were typed soon after each other, and what was before them.
  struct Word {
    std::string letters;
    double last = -1e9;
    ViewSettings view;
    std::optional<std::uint64_t> position;             // in a trace
    std::vector<std::function<void(Document&)>> made;  // how each is taken back
  };
  static void take_back(const Word& word, Document& document);

  void click(double x, double y, double time);
  void ask(double x, double y);

  Session& session_;
  Drag drag_ = Drag::nothing;
  Button button_ = Button::left;
  bool moved_ = false;
  glm::dvec2 pressed_{0};
  glm::dvec2 last_{0};
  double last_click_ = -1e9;
  Word word_;
};

}  // namespace tetmend::viewer
