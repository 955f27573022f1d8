// SPDX-License-Identifier: MIT
// One card of Nastran's bulk data: its fields, in whichever of the three forms they stand.
#include "kernel/formats/nastran_card.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fast_float/fast_float.h>

namespace tetmend::formats {
namespace {

constexpr std::size_t kSmall = 8;

std::string_view without_comment(std::string_view line) {
  line = line.substr(0, line.find('$'));
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
  return line;
}

void add(NastranCardText& card, std::string_view field) {
  card.fields.push_back(trimmed_field(field));
}

/// Fields between commas: eight, or four large ones; the next names the continuation.
void split_free(NastranCardText& card, std::string_view line, bool is_large) {
  const std::size_t most = is_large ? 4 : 8;
  std::size_t at = line.find(',');
  for (std::size_t k = 0; k < most; ++k) {
    if (at == std::string_view::npos) {
      add(card, {});
      continue;
    }
    const std::size_t next = line.find(',', at + 1);
    add(card, line.substr(at + 1, next == std::string_view::npos ? next : next - at - 1));
    at = next;
  }
}

/// Fields of fixed width. A tab goes on to the next field; where one is, they are parted by tabs.
void split_fixed(NastranCardText& card, std::string_view line, bool is_large) {
  const std::size_t width = is_large ? 2 * kSmall : kSmall;
  const std::size_t most = is_large ? 4 : 8;
  if (line.find('\t') != std::string_view::npos) {
    std::size_t at = line.find('\t');
    for (std::size_t k = 0; k < most; ++k) {
      const std::size_t next = at == std::string_view::npos ? at : line.find('\t', at + 1);
      add(card,
          at == std::string_view::npos ? std::string_view() : line.substr(at + 1, next - at - 1));
      at = next;
    }
    return;
  }
  for (std::size_t k = 0; k < most; ++k) {
    const std::size_t begin = kSmall + k * width;
    add(card, begin < line.size() ? line.substr(begin, width) : std::string_view());
  }
}

void split(NastranCardText& card, std::string_view whole) {
  const std::string_view line = without_comment(whole);
  const bool is_free = line.find(',') != std::string_view::npos;
  const std::string_view name = line.substr(0, is_free ? line.find(',') : kSmall);
  const bool is_large = name.find('*') != std::string_view::npos;
  if (is_free) {
    split_free(card, line, is_large);
  } else {
    split_fixed(card, line, is_large);
  }
}

}  // namespace

std::string_view trimmed_field(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view NastranLines::line() {
  const char* begin = next_;
  const auto left = static_cast<std::size_t>(end_ - next_);
  const void* newline = left == 0 ? nullptr : std::memchr(next_, '\n', left);
  next_ = newline == nullptr ? end_ : static_cast<const char*>(newline) + 1;
  return {begin, static_cast<std::size_t>(next_ - begin)};
}

bool NastranLines::continues() const {
  if (at_end()) return false;
  if (*next_ == '+' || *next_ == '*' || *next_ == ',') return true;
  if (*next_ != ' ' && *next_ != '\t') return false;
  NastranLines ahead = *this;
  const std::string_view line = without_comment(ahead.line());
  return !trimmed_field(line).empty() && trimmed_field(line.substr(0, kSmall)).empty();
}

void NastranLines::read(NastranCardText& card) {
  const char* begin = next_;
  card.fields.clear();
  const std::string_view first = line();
  card.name = nastran_name(first);
  split(card, first);
  while (continues()) split(card, line());
  card.text = {begin, static_cast<std::size_t>(next_ - begin)};
}

std::string nastran_name(std::string_view line) {
  std::string_view name = without_comment(line.substr(0, kSmall));
  name = name.substr(0, name.find_first_of(",*\t"));
  std::string capitals(trimmed_field(name));
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return capitals;
}

bool nastran_integer(std::string_view field, std::int64_t& value) {
  if (field.size() > 1 && field[0] == '+') field.remove_prefix(1);
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  return error == std::errc() && stop == end && !field.empty();
}

bool nastran_real(std::string_view field, double& value) {
  std::array<char, 64> text{};
  if (field.empty() || field.size() > text.size() / 2) return false;
  std::size_t size = 0;
  bool has_exponent = false;
  for (std::size_t i = field[0] == '+' ? 1 : 0; i < field.size(); ++i) {
    const char c = field[i];
    const bool is_letter = c == 'e' || c == 'E' || c == 'd' || c == 'D';
    if ((c == '+' || c == '-') && size > 0 && !has_exponent && text[size - 1] != '-') {
      text[size++] = 'e';
      has_exponent = true;
    }
    if (is_letter) has_exponent = true;
    text[size++] = is_letter ? 'e' : c;
  }
  const char* end = text.data() + size;
  const auto [stop, error] = fast_float::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end && std::isfinite(value);
}

}  // namespace tetmend::formats
