// SPDX-License-Identifier: MIT
// Which plugins a command works with.
#include "apps/plugins.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tetmend/error.h>

#include "apps/option_help.h"
#include "platform/platform.h"

namespace tetmend::apps {
namespace {

using std::filesystem::path;

constexpr const char* kVariable = "TETMEND_PLUGIN_PATH";

/// The file itself, or the libraries of a folder by name.
std::vector<path> list_plugins(const path& place) {
  std::error_code error;
  const auto status = std::filesystem::status(place, error);
  if (!std::filesystem::exists(status)) {
    throw Error(fmt::format("{}: {}: there is no such file or folder", kVariable, place.string()));
  }
  if (!std::filesystem::is_directory(status)) return {place};
  std::vector<path> files;
  try {
    for (const auto& entry : std::filesystem::directory_iterator(place)) {
      if (platform::is_library_name(entry.path())) files.push_back(entry.path());
    }
  } catch (const std::filesystem::filesystem_error& failure) {
    throw Error(fmt::format("{}: {}: {}", kVariable, place.string(), failure.code().message()));
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<path> plugins_of_environment() {
  std::vector<path> files;
  const std::string variable = platform::trusted_variable(kVariable);
  std::string_view rest = variable;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(platform::kPathSeparator), rest.size());
    if (end > 0) {
      const std::vector<path> more = list_plugins(rest.substr(0, end));
      files.insert(files.end(), more.begin(), more.end());
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return files;
}

}  // namespace

void add_plugin_option(CLI::App& command, std::vector<std::filesystem::path>& plugins) {
  command.add_option("--plugin", plugins, help_of("plugin"))
      ->type_name("FILE")
      ->allow_extra_args(false);
}

std::vector<path> all_plugins(const std::vector<path>& plugins) {
  std::vector<path> files = plugins_of_environment();
  files.insert(files.end(), plugins.begin(), plugins.end());
  return files;
}

}  // namespace tetmend::apps
