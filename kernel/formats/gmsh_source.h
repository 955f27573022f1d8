// SPDX-License-Identifier: MIT
// Numbers of a Gmsh file, which stand there as text or as bytes.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "kernel/formats/byte_reader.h"
#include "kernel/formats/text_reader.h"
#include "kernel/formats/text_rows.h"

namespace tetmend::formats {

/// Keywords are text in both codings. Binary numbers begin right behind a line break.
class GmshSource {
 public:
  explicit GmshSource(const InputFile& file) : text_(file, TextReader::kNoComments) {}

  TextReader& text() { return text_; }
  bool binary() const { return binary_; }
  bool swap() const { return swap_; }
  void set_binary() {
    binary_ = true;
    text_.locate_errors_by_byte();
  }
  void set_swap(bool swap) { swap_ = swap; }
  /// Bytes of numbers of points and elements, and of counts, in a binary file of version 4: 8, or 4 as
  /// 32-bit programs write them.
  void set_wide_size(std::size_t size) { wide_size_ = size; }
  std::size_t wide_size() const { return wide_size_; }

  /// To be called behind the name of a section whose numbers are binary in a binary file.
  void begin_numbers() {
    if (binary_) text_.skip_line();
  }

  /// An integer of 4 bytes in a binary file.
  std::int64_t integer(std::string_view what, std::int64_t low, std::int64_t high) {
    return number<std::int32_t>(what, low, high);
  }
  Label tag(std::string_view what) {
    return static_cast<Label>(integer(what, INT32_MIN, INT32_MAX));
  }
  /// An integer of wide_size() bytes in a binary file.
  std::int64_t wide(std::string_view what, std::int64_t low, std::int64_t high) {
    return wide_size_ == 8 ? number<std::int64_t>(what, low, high)
                           : number<std::uint32_t>(what, low, high);
  }
  /// A count of wide_size() bytes, of things that take at least so many bytes each.
  std::size_t count(std::string_view what, std::size_t as_text, std::size_t as_bytes) {
    return wide_size_ == 8 ? count_of<std::int64_t>(what, as_text, as_bytes)
                           : count_of<std::uint32_t>(what, as_text, as_bytes);
  }
  /// The integer of wide_size() bytes at `at` of a binary file.
  std::int64_t wide_at(const char* at, std::string_view what) const {
    return wide_size_ == 8 ? checked<std::int64_t>(at, what, 0, INT64_MAX)
                           : checked<std::uint32_t>(at, what, 0, INT64_MAX);
  }
  /// The same, of 4 bytes.
  std::size_t short_count(std::string_view what, std::size_t as_text, std::size_t as_bytes) {
    return count_of<std::int32_t>(what, as_text, as_bytes);
  }
  double real(std::string_view what) {
    return binary_ ? finite(bytes(sizeof(double), what), what) : text_.real(what);
  }

  /// The finite number at `at` of a binary file.
  double finite(const char* at, std::string_view what) const {
    const auto value = load<double>(at, swap_);
    if (!std::isfinite(value)) {
      text_.fail_at(at, fmt::format("{} is not a finite number: expected {}", value, what));
    }
    return value;
  }
  /// The integer at `at` of a binary file.
  template <class Integer>
  std::int64_t checked(const char* at, std::string_view what, std::int64_t low,
                       std::int64_t high) const {
    const std::int64_t value = load<Integer>(at, swap_);
    if (value < low || value > high) {
      text_.fail_at(
          at, fmt::format("{} is out of range: expected {}, {} to {}", value, what, low, high));
    }
    return value;
  }

  /// read_row(text, i) for rows of a text file.
  template <class ReadRow>
  void rows(std::size_t count, const ReadRow& read_row) {
    read_rows(text_, count, read_row);
  }

 private:
  const char* bytes(std::size_t size, std::string_view what) {
    if (text_.bytes_left() < size) {
      text_.fail_at(text_.position(), fmt::format("the file ends where {} is expected", what));
    }
    return text_.bytes(size, what);
  }

  template <class Integer>
  std::int64_t number(std::string_view what, std::int64_t low, std::int64_t high) {
    if (!binary_) return text_.integer(what, low, high);
    return checked<Integer>(bytes(sizeof(Integer), what), what, low, high);
  }

  template <class Integer>
  std::size_t count_of(std::string_view what, std::size_t as_text, std::size_t as_bytes) {
    if (!binary_) return text_.count(what, as_text);
    const std::string name = fmt::format("the number of {}", what);
    const char* at = bytes(sizeof(Integer), name);
    const auto value = static_cast<std::size_t>(checked<Integer>(at, name, 0, INT64_MAX));
    if (value > text_.bytes_left() / as_bytes) {
      text_.fail_at(at, fmt::format("{} {} cannot fit into the {} bytes that are left: the count "
                                    "is wrong or the file is truncated",
                                    value, what, text_.bytes_left()));
    }
    return value;
  }

  TextReader text_;
  bool binary_ = false;
  bool swap_ = false;
  std::size_t wide_size_ = 8;
};

}  // namespace tetmend::formats
