// SPDX-License-Identifier: MIT
#include "viewer/ui/remembered.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

#include <nlohmann/json.hpp>

namespace tetmend::viewer::ui {

using nlohmann::json;

namespace {

std::optional<std::filesystem::path> settings_file() {
  for (const auto& [name, below] :
       {std::pair{"XDG_CONFIG_HOME", ""}, std::pair{"APPDATA", ""}, std::pair{"HOME", ".config"}}) {
    const char* folder = std::getenv(name);  // NOLINT: one thread
    if (folder != nullptr && *folder != '\0') {
      return std::filesystem::path(folder) / below / "tetmend" / "view.json";
    }
  }
  return std::nullopt;
}

}  // namespace

void recall(Document& document) {
  const auto file = settings_file();
  if (!file) return;
  std::ifstream in(*file, std::ios::binary);
  std::stringstream text;
  if (!in || !(text << in.rdbuf())) return;
  const json settings = json::parse(text.str(), nullptr, false);
  if (!settings.is_object()) return;
  const auto theme = settings.value("theme", json());
  if (theme == "light" || theme == "dark") document.view.theme = theme.get<std::string>();
  const auto panels = settings.value("panels", json());
  if (panels.is_boolean()) document.show_panels = panels.get<bool>();
  const auto recent = settings.value("recent", json::array());
  if (!recent.is_array()) return;
  for (const json& name : recent) {
    std::error_code none;
    if (!name.is_string() || !std::filesystem::exists(name.get<std::string>(), none)) continue;
    if (std::find(document.recent.begin(), document.recent.end(), name) == document.recent.end()) {
      document.recent.push_back(name.get<std::string>());
    }
  }
}

void remember(const Document& document) {
  const auto file = settings_file();
  if (!file) return;
  std::error_code none;
  std::filesystem::create_directories(file->parent_path(), none);
  std::filesystem::path unfinished = *file;
  unfinished += ".part";
  {
    std::ofstream out(unfinished, std::ios::binary);
    const json settings = {{"theme", document.view.theme},
                           {"panels", document.show_panels},
                           {"recent", document.recent}};
    out << settings.dump(1, ' ', false, json::error_handler_t::replace) << '\n';
    out.close();
    if (!out) {
      std::filesystem::remove(unfinished, none);
      return;
    }
  }
  std::filesystem::rename(unfinished, *file, none);
}

}  // namespace tetmend::viewer::ui
