// SPDX-License-Identifier: MIT
#include "schedule/printable.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace tetmend {

namespace {

constexpr unsigned kFirstAfterC1 = 0xA0;  // U+0080 to U+009F are control characters as well

unsigned char byte(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

/// Bytes of the character at the front of the text if it can be shown as it is; else 0.
std::size_t shown_as_is(std::string_view text) {
  const unsigned first = byte(text, 0);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  unsigned code = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(text, i) & 0xC0u) != 0x80) return 0;
    code = code << 6u | (byte(text, i) & 0x3Fu);
  }
  const bool is_overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xD800 && code < 0xE000;
  return code < kFirstAfterC1 || is_overlong || is_surrogate || code > 0x10FFFF ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string shown;
  while (!text.empty()) {
    if (shown.size() >= most) return shown + "...";
    std::size_t length = shown_as_is(text);
    if (length > 0) {
      shown += text.substr(0, length);
    } else if (length = 1; text[0] == '\n') {
      shown += "\\n";
    } else if (text[0] == '\t') {
      shown += "\\t";
    } else {
      fmt::format_to(std::back_inserter(shown), "\\x{:02x}", byte(text, 0));
    }
    text.remove_prefix(length);
  }
  return shown;
}

}  // namespace tetmend
