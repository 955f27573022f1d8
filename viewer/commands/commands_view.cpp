// SPDX-License-Identifier: MIT
// Commands about camera, window and settings.
#include <algorithm>
#include <array>

#include "viewer/commands/command_group.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

json home(Session& s, const json&) {
  s.document.go_home();
  return nullptr;
}

json fit(Session& s, const json&) {
  s.document.fit();
  return nullptr;
}

json look_from(Session& s, const json& a) {
  s.document.view.camera.look_from(Arguments("look_from", a).text(0));
  return nullptr;
}

template <char Sign, char Axis>
json look_along(Session& s, const json&) {
  s.document.view.camera.look_from(std::string{Sign, Axis});
  return nullptr;
}

json theme(Session& s, const json& a) {
  std::string& now = s.document.view.theme;
  if (a.empty()) {
    now = now == "light" ? "dark" : "light";
  } else {
    apply_json(s.document.view, {{"theme", a[0]}});
  }
  return nullptr;
}

json view(Session& s, const json& a) {
  if (!a.empty()) apply_json(s.document.view, a[0]);
  return to_json(s.document.view);
}

json size(Session& s, const json& a) {
  constexpr std::size_t kMost = 8192;
  const Arguments arguments("size", a);
  s.document.resize({static_cast<int>(std::max(1U, arguments.index(0, kMost + 1))),
                     static_cast<int>(std::max(1U, arguments.index(1, kMost + 1)))});
  return nullptr;
}

json undo_view(Session& s, const json&) {
  if (!s.document.undo_view()) throw Error("there is no view before this one");
  return nullptr;
}

json redo_view(Session& s, const json&) {
  if (!s.document.redo_view()) throw Error("there is no view after this one");
  return nullptr;
}

constexpr std::array kViewCommands = {
    Command{"home", "H", kViewMenu, "home()", "Whole mesh from the home direction", &home},
    Command{"fit", "F", kViewMenu, "fit()", "Fit the selection, or the whole mesh", &fit},
    Command{"from_right", "1", kViewMenu, "from_right()", "Look from +x", &look_along<'+', 'x'>},
    Command{"from_left", "2", kViewMenu, "from_left()", "Look from -x", &look_along<'-', 'x'>},
    Command{"from_back", "3", kViewMenu, "from_back()", "Look from +y", &look_along<'+', 'y'>},
    Command{"from_front", "4", kViewMenu, "from_front()", "Look from -y", &look_along<'-', 'y'>},
    Command{"from_top", "5", kViewMenu, "from_top()", "Look from +z", &look_along<'+', 'z'>},
    Command{"from_bottom", "6", kViewMenu, "from_bottom()", "Look from -z", &look_along<'-', 'z'>},
    Command{"look_from", "", "", "look_from(\"+x\")", "Look from a side, or \"home\"", &look_from},
    Command{"undo_view", "Ctrl+Z", kViewMenu, "undo_view()", "Back to the view before", &undo_view},
    Command{"redo_view", "Ctrl+Y", kViewMenu, "redo_view()", "To the view that was undone",
            &redo_view},
    Command{"orthographic", "O", kViewMenu, "orthographic()", "Orthographic or perspective",
            &toggle<&Camera::orthographic>},
    Command{"theme", "T", kViewMenu, "theme(\"dark\")", "Light or dark", &theme},
    Command{"panels", "Tab", kViewMenu, "panels()", "Panels on or off",
            &toggle<&Document::show_panels>},
    Command{"keys", "F1", "Help", "keys()", "This list of keys", &toggle<&Document::show_keys>},
    Command{"numbers", "#", kViewMenu, "numbers()",
            "Numbers of the vertices of the call at hand or of the selection",
            &toggle<&ViewSettings::numbers>},
    Command{"all_numbers", "", kViewMenu, "all_numbers()",
            "Numbers of all vertices that are seen, as far as there is room",
            &toggle<&ViewSettings::all_numbers>},
    Command{"legend", "", kViewMenu, "legend()", "Of a trace: what the colours mean",
            &toggle<&ViewSettings::legend>},
    Command{"view", "", "", "view{peel = 2}",
            "Change settings by name; the result is the whole view", &view},
    Command{"size", "", "", "size(WIDTH, HEIGHT)", "Size of the picture in pixels", &size},
};

}  // namespace

std::span<const Command> view_commands() {
  return kViewCommands;
}

}  // namespace tetmend::viewer
