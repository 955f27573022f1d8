// SPDX-License-Identifier: MIT
// Bytes of a file, some at a time: for files that are too large to be held in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace tetmend::formats {

class FileBytes {
 public:
  /// A file that cannot be opened has no bytes.
  explicit FileBytes(const std::filesystem::path& file);

  std::uint64_t size() const { return size_; }
  /// Valid until the next call; a zero byte follows. @throws Error where the file ends before
  const char* read(std::uint64_t begin, std::size_t size);

 private:
  std::ifstream in_;
  std::filesystem::path file_;
  std::uint64_t size_ = 0;
  std::string buffer_;
};

}  // namespace tetmend::formats
