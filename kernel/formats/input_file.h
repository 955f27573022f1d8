// SPDX-License-Identifier: MIT
// A whole file in memory, and the two ways to say where in it something is wrong.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace tetmend::formats {

/// The bytes of a file, read at once and not mapped: another process that shortens the file
/// meanwhile must not end this one. A zero byte follows the last one, so that a scan for the end of
/// a word needs no bound. Of a packed file these are the bytes that it
/// was made of, and places in it are theirs.
class InputFile {
 public:
  /// @throws Error when the file is missing, a directory or unreadable, with the reason of the
  /// operating system.
  explicit InputFile(const std::filesystem::path& path);
  /// Bytes that are there already.
  InputFile(std::string name, std::string_view bytes);

  const std::string& name() const { return name_; }
  const char* begin() const { return bytes_.get(); }
  const char* end() const { return bytes_.get() + size_; }
  std::size_t size() const { return size_; }
  /// Of the file itself; of a packed file fewer than size().
  std::size_t size_of_file() const { return size_of_file_; }

  /// "FILE:LINE" of a pointer into the file. Lines are counted only here, which keeps reading fast.
  std::string line_place(const char* where) const;
  /// "FILE: byte N" of a pointer into the file, counted from 0.
  std::string byte_place(const char* where) const;

  /// Throws Error "FILE:LINE: reason"; `where` points into the file.
  [[noreturn]] void fail_at_line(const char* where, std::string_view reason) const;
  /// Throws Error "FILE: byte N: reason".
  [[noreturn]] void fail_at_byte(const char* where, std::string_view reason) const;

 private:
  void read_file(const std::filesystem::path& path);
  void copy_standard_input();
  void unpack();

  std::string name_;
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
  std::size_t size_of_file_ = 0;
};

/// A word of a file in quotes, fit for a message of one line: clipped, and printable() for a
/// terminal.
std::string in_quotes(std::string_view word);

}  // namespace tetmend::formats
