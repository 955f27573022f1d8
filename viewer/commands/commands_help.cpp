// SPDX-License-Identifier: MIT
// Commands that lead to documents, and say what program this is.
#include <array>
#include <filesystem>
#include <optional>
#include <system_error>

#include "explain/lesson_guide.h"
#include "viewer/commands/command_group.h"
#include "viewer/live/program_version.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

/// Beside the lessons, where the program was built; share/doc/tetmend, where it is installed.
std::optional<std::filesystem::path> find_document(const std::filesystem::path& name) {
  const auto lessons = explain::find_lessons();
  if (lessons.empty()) return std::nullopt;
  const std::filesystem::path folder = lessons.front().parent_path();
  for (const auto& place : {folder / "../../docs" / name, folder / "../../doc/tetmend" / name}) {
    std::error_code none;
    if (std::filesystem::exists(place, none)) return place.lexically_normal();
  }
  return std::nullopt;
}

/// A program of its own opens it; its place is told, and put on the clipboard.
void tell_place(Session& s, std::string_view what, const std::filesystem::path& name) {
  const auto place = find_document(name);
  if (!place) throw Error(fmt::format("{}: {} is not installed here", what, name.string()));
  s.host.set_clipboard(place->string());
  s.document.message = {fmt::format("the {}: {}, now on the clipboard", what, place->string()),
                        false};
}

json manual(Session& s, const json&) {
  tell_place(s, "manual", "viewer.md");
  return nullptr;
}

json lectures(Session& s, const json&) {
  tell_place(s, "lectures", "lectures");
  return nullptr;
}

json about(Session& s, const json&) {
  s.document.message = {fmt::format("tetmend {}: improves tetrahedral meshes by shell "
                                    "transformation; MIT licence",
                                    program_version()),
                        false};
  return nullptr;
}

constexpr std::string_view kHelp = "Help";

constexpr std::array kHelpCommands = {
    Command{"manual", "", kHelp, "manual()", "Where the manual of the viewer is", &manual},
    Command{"lectures", "", kHelp, "lectures()", "Where the lectures are", &lectures},
    Command{"about", "", kHelp, "about()", "Name and version", &about},
};

}  // namespace

std::span<const Command> help_commands() {
  return kHelpCommands;
}

}  // namespace tetmend::viewer
