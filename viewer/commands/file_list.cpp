// SPDX-License-Identifier: MIT
#include "viewer/commands/file_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

#include <fmt/format.h>

#include "kernel/error.h"

namespace tetmend::viewer {

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

std::vector<FileEntry> list_folder(const std::filesystem::path& folder,
                                   std::span<const std::string_view> extensions) {
  std::vector<FileEntry> entries;
  std::error_code error;
  const std::filesystem::directory_iterator all(folder, error);
  if (error) throw Error(fmt::format("{}: {}", folder.string(), error.message()));
  for (const auto& item : all) {
    FileEntry entry{.name = item.path().filename().string()};
    entry.is_folder = item.is_directory(error);
    const std::string extension = lower(item.path().extension().string());
    const bool is_wanted = entry.is_folder || std::find(extensions.begin(), extensions.end(),
                                                        extension) != extensions.end();
    if (!is_wanted || entry.name.starts_with('.')) continue;
    if (!entry.is_folder) entry.bytes = item.file_size(error);
    if (error) entry.bytes = 0;  // a link to nowhere
    entries.push_back(std::move(entry));
  }
  std::sort(entries.begin(), entries.end(), [](const FileEntry& a, const FileEntry& b) {
    return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name;
  });
  return entries;
}

std::string format_bytes(std::uintmax_t bytes) {
  constexpr std::array<const char*, 4> kUnits = {"kB", "MB", "GB", "TB"};
  constexpr double kThousand = 1000;
  if (bytes < 1000) return fmt::format("{} B", bytes);
  double value = static_cast<double>(bytes) / kThousand;
  std::size_t unit = 0;
  while (value >= kThousand && unit + 1 < kUnits.size()) {
    value /= kThousand;
    ++unit;
  }
  return fmt::format("{:.1f} {}", value, kUnits[unit]);
}

}  // namespace tetmend::viewer
