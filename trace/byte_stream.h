// SPDX-License-Identifier: MIT
// Numbers in few bytes: what a trace file is made of.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kernel/error.h"

namespace tetmend {

static_assert(std::endian::native == std::endian::little, "trace files are little-endian");

/// Grows at its end; may be cut back to an earlier size.
class ByteWriter {
 public:
  std::size_t size() const { return size_; }
  std::span<const std::byte> bytes() const { return {bytes_.data(), size_}; }
  /// Precondition: `size` is at most size().
  void cut(std::size_t size) { size_ = size; }

  /// Seven bits a byte, the lowest first: one byte below 128.
  void put(std::uint64_t value) {
    std::byte* out = room_for(kLongest);
    while (value >= 128) {
      *out++ = static_cast<std::byte>(value | 128u);
      value >>= 7;
    }
    *out++ = static_cast<std::byte>(value);
    size_ = static_cast<std::size_t>(out - bytes_.data());
  }
  /// The same for numbers around 0.
  void put_signed(std::int64_t value) {
    put((static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
  }
  /// How far `value` lies from `from`, which becomes `value`.
  void put_step(std::uint32_t value, std::uint32_t& from) {
    put_signed(static_cast<std::int64_t>(value) - static_cast<std::int64_t>(from));
    from = value;
  }
  /// The number's own bytes.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put_raw(const T& value) { put_bytes(&value, sizeof value); }
  void put_text(std::string_view text) {
    put(text.size());
    put_bytes(text.data(), text.size());
  }
  void put_bytes(const void* bytes, std::size_t size) {
    if (size == 0) return;
    std::memcpy(room_for(size), bytes, size);
    size_ += size;
  }

 private:
  static constexpr std::size_t kLongest = 10;

  std::byte* room_for(std::size_t size) {
    if (bytes_.size() - size_ < size) bytes_.resize(2 * bytes_.size() + size);
    return bytes_.data() + size_;
  }

  std::vector<std::byte> bytes_;
  std::size_t size_ = 0;
};

/// Reads what a ByteWriter wrote.
class ByteReader {
 public:
  /// Thrown when the bytes end too early or make no sense.
  class Damage : public Error {
   public:
    explicit Damage(const std::string& reason = "its content makes no sense") : Error(reason) {}
  };

  explicit ByteReader(std::span<const std::byte> bytes)
      : next_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  bool at_end() const { return next_ == end_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - next_); }

  // All of these: @throws Damage
  std::uint64_t get() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      if (next_ == end_) throw Damage("a number is cut off");
      const auto byte = static_cast<std::uint64_t>(*next_++);
      if (shift == 63 && byte > 1) break;  // more than 64 bits
      value |= (byte & 127u) << shift;
      if (byte < 128) return value;
    }
    throw Damage("a number has more than 64 bits");
  }
  std::uint32_t get32() {
    const std::uint64_t value = get();
    if (value > UINT32_MAX) throw Damage("a number has more than 32 bits");
    return static_cast<std::uint32_t>(value);
  }
  /// A number of things that take at least so many bytes each: as many may be made room for.
  std::size_t get_count(std::size_t least_bytes = 1) {
    const std::uint64_t value = get();
    if (value > left() / least_bytes) throw Damage("it counts more than its bytes can hold");
    return value;
  }
  std::int64_t get_signed() {
    const std::uint64_t value = get();
    return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
  }
  std::uint32_t get_step(std::uint32_t& from) {
    const std::int64_t step = get_signed();
    const std::int64_t least = -static_cast<std::int64_t>(from);
    if (step < least || step > least + UINT32_MAX) throw Damage("a step leads out of 32 bits");
    return from = static_cast<std::uint32_t>(step - least);
  }
  template <class T>
  requires std::is_trivially_copyable_v<T> T get_raw() {
    T value;
    get_bytes(&value, sizeof value);
    return value;
  }
  std::string get_text() {
    std::string text(get_count(), '\0');
    get_bytes(text.data(), text.size());
    return text;
  }
  /// A text for a terminal: control characters become '?'.
  std::string get_line() {
    std::string text = get_text();
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }
    return text;
  }
  void get_bytes(void* bytes, std::size_t size) {
    if (left() < size) throw Damage("it ends too early");
    if (size > 0) std::memcpy(bytes, next_, size);
    next_ += size;
  }

 private:
  const std::byte* next_;
  const std::byte* end_;
};

}  // namespace tetmend
