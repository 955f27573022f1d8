// SPDX-License-Identifier: MIT
// Numbers of a binary file in either byte order; errors carry the file and the byte.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "kernel/formats/input_file.h"

namespace tetmend::formats {

/// The number with its bytes in the opposite order.
template <class T>
T byte_swapped(T value) {
  static_assert(sizeof(T) == 1 || sizeof(T) == 2 || sizeof(T) == 4 || sizeof(T) == 8);
  if constexpr (sizeof(T) == 2) {
    return std::bit_cast<T>(__builtin_bswap16(std::bit_cast<std::uint16_t>(value)));
  } else if constexpr (sizeof(T) == 4) {
    return std::bit_cast<T>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
  } else if constexpr (sizeof(T) == 8) {
    return std::bit_cast<T>(__builtin_bswap64(std::bit_cast<std::uint64_t>(value)));
  } else {
    return value;
  }
}

/// The number at `from`, which need not be aligned.
template <class T>
T load(const char* from, bool swap) {
  static_assert(std::is_arithmetic_v<T>);
  T value;
  std::memcpy(&value, from, sizeof(T));
  return swap ? byte_swapped(value) : value;
}

/// The integer of 1, 2, 4 or 8 bytes at `from`. An unsigned one beyond 2^63 becomes negative, which is
/// refused as the true value would be wherever a number of that size makes no sense.
inline std::int64_t load_integer(const char* from, std::size_t size, bool is_signed, bool swap) {
  switch (size) {
    case 1:
      return is_signed ? load<std::int8_t>(from, false) : load<std::uint8_t>(from, false);
    case 2:
      return is_signed ? load<std::int16_t>(from, swap) : load<std::uint16_t>(from, swap);
    case 4:
      return is_signed ? load<std::int32_t>(from, swap)
                       : std::int64_t{load<std::uint32_t>(from, swap)};
    default:
      return load<std::int64_t>(from, swap);
  }
}

/// Reads a binary file at positions that the file itself names; no read leaves the file.
class ByteReader {
 public:
  explicit ByteReader(const InputFile& file) : file_(file) {}

  void set_swap(bool swap) { swap_ = swap; }
  bool swap() const { return swap_; }
  std::size_t position() const { return position_; }
  /// `position` may be at most the size of the file.
  void seek(std::size_t position) { position_ = position; }
  std::size_t size() const { return file_.size(); }
  std::size_t bytes_left() const { return file_.size() - position_; }

  /// The next number. @throws Error at the end of the file.
  template <class T>
  T number(std::string_view what) {
    if (bytes_left() < sizeof(T)) fail_at_end(what);
    const T value = load<T>(file_.begin() + position_, swap_);
    position_ += sizeof(T);
    return value;
  }
  /// Bytes from the present position on; the caller has checked how many there are.
  const char* here() const { return file_.begin() + position_; }

  std::string place_of(const char* where) const { return file_.byte_place(where); }
  [[noreturn]] void fail_at(std::size_t position, std::string_view reason) const {
    file_.fail_at_byte(file_.begin() + position, reason);
  }
  [[noreturn]] void fail_at(const char* where, std::string_view reason) const {
    file_.fail_at_byte(where, reason);
  }

 private:
  [[noreturn]] void fail_at_end(std::string_view what) const;

  const InputFile& file_;
  std::size_t position_ = 0;
  bool swap_ = false;
};

}  // namespace tetmend::formats
