// SPDX-License-Identifier: MIT
// A file that appears under its name only when it is complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kernel/formats/pending_file.h"
#include "platform/platform.h"

namespace tetmend {

namespace formats {
class GzipWriter;
}

/// Text and numbers in memory, on their way to a file.
class OutputBuffer {
 public:
  void clear() { used_ = 0; }
  std::string_view content() const { return {bytes_.get(), used_}; }

  void put(std::string_view text) {
    if (text.empty()) return;
    std::memcpy(room_for(text.size()), text.data(), text.size());
    used_ += text.size();
  }
  void put(char c) { *room_for(1) = c, used_ += 1; }
  void put_integer(std::int64_t value);
  /// The shortest digits from which the same double is read back.
  void put_real(double value);
  /// The number's own bytes; the byte order is the caller's.
  template <class T>
  requires std::is_arithmetic_v<T>
  void put_bytes(T value) {
    std::memcpy(room_for(sizeof(T)), &value, sizeof(T));
    used_ += sizeof(T);
  }

 private:
  char* room_for(std::size_t size) {
    if (capacity_ - used_ < size) grow(size);
    return bytes_.get() + used_;
  }
  void grow(std::size_t size);

  std::unique_ptr<char[]> bytes_;
  std::size_t capacity_ = 0;
  std::size_t used_ = 0;
};

/// Buffered output into a file that takes its name with `commit()`, see PendingFile. Without
/// `commit()` (an exception, a full disk) it vanishes and an older file stays as it was. Under a name
/// that ends in .gz it is packed. What goes to standard output, see is_standard_stream(), goes there
/// when it is complete.
class OutputFile {
 public:
  /// @throws Error as PendingFile does
  explicit OutputFile(const std::filesystem::path& target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// All of these: @throws Error with the reason of the operating system when the disk is full.
  void put(std::string_view text);
  void put(char c) { put(std::string_view(&c, 1)); }
  void put_integer(std::int64_t value) { buffer_.put_integer(value), flush_if_full(); }
  /// The shortest digits from which the same double is read back.
  void put_real(double value) { buffer_.put_real(value), flush_if_full(); }
  /// The number's own bytes; the byte order is the caller's.
  template <class T>
  requires std::is_arithmetic_v<T>
  void put_bytes(T value) { buffer_.put_bytes(value), flush_if_full(); }
  /// What is put from now on gets the line breaks of this text: those of Windows if its first is one.
  void use_line_breaks_of(std::string_view text);
  /// Puts a text that keeps its line breaks.
  void put_as_it_is(std::string_view text);
  /// Calls fill(block, buffer) for each block from 0 on, several at once as threads allow, and
  /// writes what they put into their buffers in the order of the blocks.
  void put_blocks(std::size_t blocks,
                  const std::function<void(std::size_t block, OutputBuffer& buffer)>& fill);

  /// Writes out what is buffered and closes the temporary file: what can fail for want of space
  /// fails here.
  void finish();
  /// Further files that appear together with one; asked for when that is complete.
  using Companions = std::function<std::vector<formats::PendingFile*>()>;
  /// Finishes, then gives the file its name.
  void commit(const Companions& companions = {});
  /// What gives the file its name, for one that is finished and a companion of another; null for
  /// standard output.
  formats::PendingFile* pending() { return file_ ? &*file_ : nullptr; }
  /// The same for files that belong together: all are new, or after an error all old. Standard output
  /// alone comes after its companions.
  static void commit_all(std::span<OutputFile* const> outputs, const Companions& companions = {});

 private:
  void copy_to_standard_output();
  void flush_if_full() {
    if (buffer_.content().size() >= kFull) flush();
  }
  void flush();
  void write_out(std::string_view bytes);
  void write_packed(std::string_view bytes);
  void write_raw(std::string_view bytes);
  [[noreturn]] static void fail_stream(int error);

  static constexpr std::size_t kFull = std::size_t{1} << 18;
  std::optional<formats::PendingFile> file_;  // nothing: standard output
  OutputBuffer buffer_;
  std::unique_ptr<formats::GzipWriter> gzip_;  // null: not packed
  platform::Descriptor memory_;                // what is to go to standard output
  bool is_finished_ = false;
  bool is_of_windows_ = false;  // lines end so
};

}  // namespace tetmend
