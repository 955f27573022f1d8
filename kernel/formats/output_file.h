// SPDX-License-Identifier: MIT
// A file that appears under its name only when it is complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

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

/// Buffered output into a temporary file beside the target, which `commit()` renames to the target.
/// Without `commit()` (an exception, a full disk) the temporary file vanishes and an older target
/// stays as it was. Under a name that ends in .gz it is packed. Links are followed, and the
/// permissions of an older target are kept. What goes to standard output, see is_standard_stream(),
/// goes there when it is complete.
class OutputFile {
 public:
  /// @throws Error when the target is a directory or write-protected or when its folder cannot be
  /// written.
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
  /// Calls fill(block, buffer) for each block from 0 on, several at once as threads allow, and
  /// writes what they put into their buffers in the order of the blocks.
  void put_blocks(std::size_t blocks,
                  const std::function<void(std::size_t block, OutputBuffer& buffer)>& fill);

  /// Writes out what is buffered and closes the temporary file: what can fail for want of space
  /// fails here. Where several files belong together, finish all before the first commit.
  void finish();
  /// Finishes, then gives the file its name.
  void commit();

 private:
  void make_temporary();
  void copy_to_standard_output();
  void flush_if_full() {
    if (buffer_.content().size() >= kFull) flush();
  }
  void flush();
  void write_out(std::string_view bytes);
  void write_raw(std::string_view bytes) { write_to(fd_, bytes); }
  void write_to(int fd, std::string_view bytes) const;
  [[noreturn]] void fail(int error) const;

  static constexpr std::size_t kFull = std::size_t{1} << 18;
  std::string name_;  // as the user gave it, for messages
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  OutputBuffer buffer_;
  std::unique_ptr<formats::GzipWriter> gzip_;  // null: not packed
  int fd_ = -1;
  bool committed_ = false;
  bool is_standard_ = false;
};

}  // namespace tetmend
