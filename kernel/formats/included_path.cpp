// SPDX-License-Identifier: MIT
// The files that a deck includes, by the names that it has for them.
#include "kernel/formats/included_path.h"

#include <algorithm>
#include <string>
#include <system_error>

#include <fmt/format.h>

namespace tetmend::formats {

std::filesystem::path included_path(const std::filesystem::path& folder, std::string_view name) {
  const bool is_quoted = name.size() > 1 && (name.front() == '"' || name.front() == '\'') &&
                         name.back() == name.front();
  if (is_quoted) name = name.substr(1, name.size() - 2);
  const std::filesystem::path as_it_stands = folder / name;
  std::error_code ignored;
  if (name.find('\\') == std::string_view::npos || std::filesystem::exists(as_it_stands, ignored)) {
    return as_it_stands;
  }
  std::string with_slashes(name);
  std::replace(with_slashes.begin(), with_slashes.end(), '\\', '/');
  const std::filesystem::path made = folder / with_slashes;
  return std::filesystem::exists(made, ignored) ? made : as_it_stands;
}

std::filesystem::path place_of_included(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path place = std::filesystem::weakly_canonical(path, error);
  return error ? path.lexically_normal() : place;
}

std::vector<std::string> included_files_stay(const std::filesystem::path& file,
                                             const std::string& folder, std::string_view keyword) {
  if (folder.empty() ||
      std::filesystem::absolute(file).parent_path().lexically_normal() == folder) {
    return {};
  }
  return {fmt::format("the files of {} stay in {}: the output lies elsewhere", keyword, folder)};
}

}  // namespace tetmend::formats
