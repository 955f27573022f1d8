// SPDX-License-Identifier: MIT
// What a folder holds, as a file browser lists it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tetmend::viewer {

struct FileEntry {
  std::string name;
  bool is_folder = false;
  std::uintmax_t bytes = 0;  ///< of a file
};

/// Folders, then files with one of the extensions (".mesh"; case does not matter), both by name.
/// Hidden ones are left out. @throws Error when the folder cannot be read.
std::vector<FileEntry> list_folder(const std::filesystem::path& folder,
                                   std::span<const std::string_view> extensions);

/// "812 B", "1.2 MB".
std::string format_bytes(std::uintmax_t bytes);

}  // namespace tetmend::viewer
