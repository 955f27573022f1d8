// SPDX-License-Identifier: MIT
#include "kernel/printable.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace tetmend {

namespace {

using Range = std::pair<char32_t, char32_t>;

/// What is not shown, in ascending order.
constexpr std::array<Range, 9> kHidden = {{
    {0x00, 0x1F},      // control characters
    {0x7F, 0x9F},      // DEL, and more of these
    {0x61C, 0x61C},    // marks of text direction
    {0x200E, 0x200F},  //
    {0x2028, 0x202E},  // separators of lines and paragraphs, text direction
    {0x2066, 0x2069},  // text direction
    {0xD800, 0xDFFF},  // halves of pairs
    {0xFDD0, 0xFDEF},  // no characters
    {0xFFFE, 0xFFFF},  // nor these, in all planes
}};

bool is_shown(char32_t code) {
  if (code >= ' ' && code < 0x7F) return true;  // nearly all
  if (code > 0x10FFFF || (code & 0xFFFEu) == 0xFFFE) return false;
  return std::none_of(kHidden.begin(), kHidden.end(), [&](const Range& range) {
    return code >= range.first && code <= range.second;
  });
}

unsigned char byte(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

struct Character {
  char32_t code = 0;
  std::size_t length = 1;  ///< bytes; 1 beyond ASCII: no UTF-8
};

/// At the front of the text, which is not empty.
Character first_of(std::string_view text) {
  const unsigned first = byte(text, 0);
  const Character as_latin{first, 1};
  if (first < 0xC2 || first > 0xF4) return as_latin;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  char32_t code = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(text, i) & 0xC0u) != 0x80) return as_latin;
    code = code << 6u | (byte(text, i) & 0x3Fu);
  }
  const bool is_overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xD800 && code < 0xE000;
  if (is_overlong || is_surrogate || code > 0x10FFFF) return as_latin;
  return {code, length};
}

void append_in_words(char32_t code, std::string& to) {
  const auto number = static_cast<unsigned>(code);
  if (code == '\n') {
    to += "\\n";
  } else if (code == '\t') {
    to += "\\t";
  } else if (code < 0x100) {
    fmt::format_to(std::back_inserter(to), "\\x{:02x}", number);
  } else if (code < 0x10000) {
    fmt::format_to(std::back_inserter(to), "\\u{:04x}", number);
  } else {
    fmt::format_to(std::back_inserter(to), "\\U{:08x}", number);
  }
}

/// At most two bytes of UTF-8.
void append_latin(char32_t code, std::string& to) {
  to += static_cast<char>(0xC0u | code >> 6u);
  to += static_cast<char>(0x80u | (code & 0x3Fu));
}

bool is_break(std::string_view text) {
  return text[0] == '\n' || text[0] == '\t' || text.starts_with("\r\n");
}

std::string shown(std::string_view text, std::size_t most, bool keeps_breaks) {
  std::string result;
  while (!text.empty()) {
    if (result.size() >= most) return result + "...";
    const Character next = first_of(text);
    if (is_shown(next.code) || (keeps_breaks && is_break(text))) {
      if (next.length == 1 && next.code >= 0x80) {
        append_latin(next.code, result);
      } else {
        result += text.substr(0, next.length);
      }
    } else {
      append_in_words(next.code, result);
    }
    text.remove_prefix(next.length);
  }
  return result;
}

}  // namespace

std::string printable(std::string_view bytes, std::size_t most) {
  return shown(bytes, most, false);
}

std::string printable_lines(std::string_view bytes) {
  return shown(bytes, std::string_view::npos, true);
}

bool is_printable(std::string_view bytes) {
  while (!bytes.empty()) {
    const Character next = first_of(bytes);
    if (!is_shown(next.code) || (next.length == 1 && next.code >= 0x80)) return false;
    bytes.remove_prefix(next.length);
  }
  return true;
}

}  // namespace tetmend
