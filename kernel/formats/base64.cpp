// SPDX-License-Identifier: MIT
// Bytes as text: 64 characters, each for 6 bits.
#include "kernel/formats/base64.h"

#include <array>
#include <cstdint>

namespace tetmend::formats {

namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::int8_t kNone = -1;
constexpr std::int8_t kPadding = -2;
constexpr std::int8_t kSpace = -3;

constexpr std::array<std::int8_t, 256> make_values() {
  std::array<std::int8_t, 256> values{};
  for (auto& value : values) value = kNone;
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  }
  values['='] = kPadding;
  for (const char c : {' ', '\t', '\n', '\r'}) values[static_cast<unsigned char>(c)] = kSpace;
  return values;
}

constexpr std::array<std::int8_t, 256> kValues = make_values();

}  // namespace

void decode_base64(std::string_view& text, std::size_t size, std::string& bytes) {
  std::uint32_t group = 0;
  unsigned digits = 0;
  unsigned padding = 0;
  std::size_t taken = 0;
  for (std::size_t i = 0; i < text.size() && bytes.size() < size; ++i) {
    const std::int8_t value = kValues[static_cast<unsigned char>(text[i])];
    if (value == kSpace) continue;
    if (value == kNone || (value >= 0 && padding > 0)) break;
    padding += value == kPadding ? 1 : 0;
    group = group << 6 | (value == kPadding ? 0 : static_cast<std::uint32_t>(value));
    if (++digits < 4) continue;
    if (padding > 2) break;
    bytes += static_cast<char>(group >> 16);
    if (padding < 2) bytes += static_cast<char>(group >> 8);
    if (padding < 1) bytes += static_cast<char>(group);
    group = 0;
    digits = 0;
    padding = 0;
    taken = i + 1;
  }
  text.remove_prefix(taken);
}

std::string encode_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_there = i + k < bytes.size();
      group = group << 8 | (is_there ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    const std::size_t digits = bytes.size() - i >= 3 ? 4 : bytes.size() - i + 1;
    for (std::size_t k = 0; k < 4; ++k) {
      text += k < digits ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

}  // namespace tetmend::formats
