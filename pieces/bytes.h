// SPDX-License-Identifier: MIT
// Numbers and arrays as the bytes of a message or a file, in this machine's byte order.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kernel/error.h"

namespace tetmend::pieces {

template <class Value>
void put(const Value& value, std::string& bytes) {
  static_assert(std::is_trivially_copyable_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

template <class Value>
void put(const std::vector<Value>& values, std::string& bytes) {
  put(std::uint64_t{values.size()}, bytes);
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

inline void put(const std::string& text, std::string& bytes) {
  put(std::uint64_t{text.size()}, bytes);
  bytes.append(text);
}

/// Takes so many bytes off the front. @throws Error when there are fewer.
/// The value whose bytes are at `at`, which need not be aligned.
template <class Value>
Value value_at(const char* at) {
  static_assert(std::is_trivially_copyable_v<Value>);
  Value value;
  std::memcpy(&value, at, sizeof(value));
  return value;
}

inline std::string_view take_front(std::string_view& bytes, std::uint64_t size) {
  if (size > bytes.size()) throw Error("a piece ends too early");
  const std::string_view front = bytes.substr(0, size);
  bytes.remove_prefix(size);
  return front;
}

template <class Value>
void take(std::string_view& bytes, Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  const std::string_view front = take_front(bytes, sizeof(value));
  std::memcpy(static_cast<void*>(&value), front.data(), sizeof(value));
}

/// @throws Error also for a byte that is no truth value
inline void take(std::string_view& bytes, bool& value) {
  const std::string_view front = take_front(bytes, 1);
  if (front[0] != 0 && front[0] != 1) throw Error("a truth value is none");
  value = front[0] != 0;
}

template <class Value>
void take(std::string_view& bytes, std::vector<Value>& values) {
  std::uint64_t count = 0;
  take(bytes, count);
  if (count > bytes.size() / sizeof(Value)) throw Error("a piece ends too early");
  values.resize(count);
  if (count == 0) return;
  const std::string_view front = take_front(bytes, count * sizeof(Value));
  std::memcpy(static_cast<void*>(values.data()), front.data(), front.size());
}

inline void take(std::string_view& bytes, std::string& text) {
  std::uint64_t size = 0;
  take(bytes, size);
  text = take_front(bytes, size);
}

}  // namespace tetmend::pieces
