// SPDX-License-Identifier: MIT
// Systematic damage to a file: each byte changed, and a cut at each byte.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "tests/kernel/formats/fixtures.h"

namespace tetmend::test {

/// Sets one byte of a file at a time: to write the whole file for each would take a hundred times
/// as long.
class ByteSetter {
 public:
  explicit ByteSetter(const std::filesystem::path& file) : fd_(::open(file.c_str(), O_WRONLY)) {}
  ~ByteSetter() { ::close(fd_); }
  ByteSetter(const ByteSetter&) = delete;
  ByteSetter& operator=(const ByteSetter&) = delete;
  void set(std::size_t position, char value) {
    REQUIRE(::pwrite(fd_, &value, 1, static_cast<off_t>(position)) == 1);
  }

 private:
  int fd_;
};

/// Reading gives an Error or a mesh that keeps every promise.
inline bool reads_soundly(const std::filesystem::path& file) {
  try {
    return is_sound(read_mesh(file));
  } catch (const Error&) {
    return true;
  }
}

/// Reads `file` once for each byte of `damaged` (the same file or a companion) and each of several
/// values in its place.
inline void change_each_byte(const std::filesystem::path& file,
                             const std::filesystem::path& damaged) {
  const std::string content = read_text(damaged);
  constexpr std::array<char, 9> kValues = {'\0', '\xff', '\x7f', ' ', '9', '-', 'e', '\n', '#'};
  ByteSetter setter(damaged);
  std::size_t unsound = 0;
  for (std::size_t i = 0; i < content.size(); ++i) {
    for (const char value : kValues) {
      setter.set(i, value);
      unsound += reads_soundly(file) ? 0 : 1;
    }
    for (const int bit : {0x01, 0x80}) {
      setter.set(i, static_cast<char>(content[i] ^ bit));
      unsound += reads_soundly(file) ? 0 : 1;
    }
    setter.set(i, content[i]);
  }
  CHECK(unsound == 0);
}

/// Reads `file` once for each number of bytes that may be left of it. The file is used up.
inline void cut_at_each_byte(const std::filesystem::path& file) {
  std::size_t unsound = 0;
  for (std::size_t size = std::filesystem::file_size(file); size-- > 0;) {
    std::filesystem::resize_file(file, size);
    unsound += reads_soundly(file) ? 0 : 1;
  }
  CHECK(unsound == 0);
}

}  // namespace tetmend::test
