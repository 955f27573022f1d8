// SPDX-License-Identifier: MIT
// Commands about files, the clipboard and the program.
#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "explain/json_text.h"
#include "viewer/commands/command_group.h"
#include "viewer/mesh/image.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

json open_file(Session& s, const json& a) {
  if (a.empty()) {
    s.document.question = FileQuestion::open;
  } else {
    s.document.begin_to_open(Arguments("open", a).text(0));
  }
  return nullptr;
}

json save(Session& s, const json& a) {
  need_mesh(s.document);
  if (a.empty()) {
    s.document.question = FileQuestion::save;
  } else {
    s.document.save(Arguments("save", a).text(0));
  }
  return nullptr;
}

json compare(Session& s, const json& a) {
  s.document.compare_with(Arguments("compare", a).text(0));
  return nullptr;
}

json reload(Session& s, const json&) {
  need_mesh(s.document);
  s.document.begin_to_open(std::string(s.document.file()));
  return nullptr;
}

/// "tetmend-view.png", or with a number that is not taken yet.
std::string new_picture() {
  std::string name = "tetmend-view.png";
  for (unsigned i = 2; std::filesystem::exists(name); ++i) {
    name = fmt::format("tetmend-view-{}.png", i);
  }
  return name;
}

/// Of a picture that was written under a name that the user has not chosen.
Offer offer_to_remove(const std::string& file) {
  const auto remove = [path = std::filesystem::absolute(file)](Document& document) {
    std::error_code trouble;
    std::filesystem::remove(path, trouble);
    document.message = {fmt::format("removed {}", path.string()), false};
    if (trouble) document.message = {fmt::format("{}: {}", path.string(), trouble.message()), true};
  };
  return {fmt::format("The picture is in {}.", std::filesystem::absolute(file).string()),
          "Remove it", remove};
}

json screenshot(Session& s, const json& a) {
  const std::string file = a.empty() ? new_picture() : Arguments("screenshot", a).text(0);
  write_png(file, s.host.render(s.document));
  s.document.message = {"wrote " + file, false};
  if (a.empty()) s.document.offer = offer_to_remove(file);
  return nullptr;
}

json copy_view(Session& s, const json&) {
  s.host.set_clipboard(explain::json_text(to_json(s.document.view), 2));
  s.document.message = {"the view is on the clipboard, as JSON", false};
  return nullptr;
}

json paste_view(Session& s, const json&) {
  apply_json_text(s.document.view, s.host.clipboard());
  s.document.message = {"view taken from the clipboard", false};
  return nullptr;
}

json quit(Session& s, const json&) {
  s.document.quit = true;
  return nullptr;
}

constexpr std::array kFileCommands = {
    Command{"open", "Ctrl+O", kFileMenu, "open(\"FILE\")", "Open a mesh or a trace", &open_file},
    Command{"save", "Ctrl+S", kFileMenu, "save(\"FILE\")", "Save the mesh as it is shown", &save},
    Command{"reload", "F5", kFileMenu, "reload()", "Read the file again", &reload},
    Command{"compare", "", "", "compare(\"FILE\")",
            "Show the statistics of another mesh beside: the state before", &compare},
    Command{
        "screenshot", "P", kFileMenu, "screenshot(\"FILE.png\")",
        "Write the picture; without a name to tetmend-view.png, or with a number if that is there",
        &screenshot},
    Command{"copy_view", "Ctrl+C", kFileMenu, "copy_view()", "Copy the view as JSON", &copy_view},
    Command{"paste_view", "Ctrl+V", kFileMenu, "paste_view()", "Take the view from the clipboard",
            &paste_view},
    Command{"quit", "Ctrl+Q", kFileMenu, "quit()", "Quit", &quit},
};

}  // namespace

std::span<const Command> file_commands() {
  return kFileCommands;
}

}  // namespace tetmend::viewer
