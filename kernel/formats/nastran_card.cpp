// SPDX-License-Identifier: MIT
// One card of Nastran's bulk data: its fields, in whichever of the three forms they stand.
#include "kernel/formats/nastran_card.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fast_float/fast_float.h>

namespace tetmend::formats {
namespace {

constexpr std::size_t kSmall = 8;

bool is_padding(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

char to_capital(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

std::string_view without_comment(std::string_view line) {
  line = line.substr(0, line.find('$'));
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
  return line;
}

void add(NastranCardText& card, std::string_view field) {
  card.fields.push_back(trimmed_field(field));
}

bool is_blank_text(std::string_view text) {
  return trimmed_field(text).empty();
}

/// What names a card or a continuation: up to the first comma or tab, or eight columns.
std::string_view first_field(std::string_view line) {
  const std::size_t end = line.find_first_of(",\t");
  return line.substr(
      0, end == std::string_view::npos || line[end] == '\t' ? std::min(end, kSmall) : end);
}

/// A continuation is named by what the line before ends in: "+A", or alone "+" or "*".
bool is_mark(std::string_view field, std::string_view next_name) {
  if (field.starts_with('+') || field.starts_with('*')) return true;
  next_name = trimmed_field(next_name);
  return next_name.size() > 1 && !field.empty() && next_name.substr(1) == field;
}

bool is_number(std::string_view field) {
  std::int64_t integer = 0;
  double real = 0;
  return nastran_integer(field, integer) || nastran_real(field, real);
}

/// Fields between commas: eight, or four large ones; the next names the continuation. Where it does
/// not, it is data, and so is what follows: as on lines of continuation of their own.
void split_free(NastranCardText& card, std::string_view line, std::size_t most,
                std::string_view next_name) {
  const std::size_t begin = card.fields.size();
  for (std::size_t at = line.find(','); at != std::string_view::npos;) {
    const std::size_t next = line.find(',', at + 1);
    add(card, line.substr(at + 1, next == std::string_view::npos ? next : next - at - 1));
    at = next;
  }
  std::size_t count = card.fields.size() - begin;
  while (count > 0 && card.fields.back().empty()) {
    card.fields.pop_back();
    --count;
  }
  if (count > most) {
    const auto tenth = card.fields.begin() + static_cast<std::ptrdiff_t>(begin + most);
    const bool is_last = count == most + 1;
    if (is_mark(*tenth, next_name) || (is_last && !is_number(*tenth))) {
      card.fields.erase(tenth);
      --count;
    }
  }
  const std::size_t lines = std::max<std::size_t>(1, (count + most - 1) / most);
  card.fields.resize(begin + lines * most);
}

/// Fields of fixed width; a tab goes on to the next multiple of eight columns, or ends a full field.
void split_fixed(NastranCardText& card, std::string_view line, std::size_t width,
                 std::size_t most) {
  std::size_t at = 0;
  std::size_t column = 0;
  const auto go_to = [&](std::size_t end) {
    const bool is_behind_full = at > 0 && at < line.size() && line[at] == '\t' &&
                                line[at - 1] != ' ' && line[at - 1] != '\t';
    if (is_behind_full) ++at;
    const std::size_t begin = at;
    for (; at < line.size() && column < end; ++at) {
      column = line[at] == '\t' ? (column / kSmall + 1) * kSmall : column + 1;
    }
    return line.substr(begin, at - begin);
  };
  go_to(kSmall);
  for (std::size_t k = 0; k < most; ++k) add(card, go_to(kSmall + (k + 1) * width));
}

void split(NastranCardText& card, std::string_view whole, std::string_view next_name) {
  const std::string_view line = without_comment(whole);
  if (line.size() < whole.size() && whole[line.size()] == '$') card.has_end_comments = true;
  const std::size_t comma = line.find(',');
  const bool is_free = comma != std::string_view::npos;
  const std::string_view name = is_free ? line.substr(0, comma) : line.substr(0, kSmall);
  const bool is_large = name.find('*') != std::string_view::npos;
  const std::size_t most = is_large ? 4 : 8;
  if (is_free) {
    split_free(card, line, most, next_name);
  } else {
    split_fixed(card, line, is_large ? 2 * kSmall : kSmall, most);
  }
}

/// What names the continuation of a line: its tenth field, or the fifth large one.
std::string_view mark_of(std::string_view whole) {
  const std::string_view line = without_comment(whole);
  if (line.find('\t') != std::string_view::npos) return {};
  std::size_t at = line.find(',');
  if (at == std::string_view::npos) {
    constexpr std::size_t kMarks = 72;
    return line.size() <= kMarks ? std::string_view() : trimmed_field(line.substr(kMarks, kSmall));
  }
  const bool is_large = line.substr(0, at).find('*') != std::string_view::npos;
  for (int left = is_large ? 4 : 8; left > 0; --left) {
    at = line.find(',', at + 1);
    if (at == std::string_view::npos) return {};
  }
  return trimmed_field(line.substr(at + 1, line.find(',', at + 1) - at - 1));
}

/// Of the continuation "+A1" that is "A1".
std::string_view key_of_name(std::string_view line) {
  const std::string_view name = trimmed_field(first_field(without_comment(line)));
  return name.empty() ? name : name.substr(1);
}

}  // namespace

std::string_view trimmed_field(std::string_view text) {
  std::size_t begin = 0;
  std::size_t end = text.size();
  while (begin != end && is_padding(text[begin])) ++begin;
  while (begin != end && is_padding(text[end - 1])) --end;
  return text.substr(begin, end - begin);
}

std::string_view NastranLines::line() {
  const char* begin = next_;
  const auto left = static_cast<std::size_t>(end_ - next_);
  const void* newline = left == 0 ? nullptr : std::memchr(next_, '\n', left);
  next_ = newline == nullptr ? end_ : static_cast<const char*>(newline) + 1;
  return {begin, static_cast<std::size_t>(next_ - begin)};
}

char NastranLines::initial() const {
  for (const char* c = next_; c != end_ && c != next_ + kSmall && *c != '\n'; ++c) {
    if (*c != ' ') return to_capital(*c);
  }
  return '\0';
}

bool NastranLines::begins_with(std::string_view word) const {
  const char* at = next_;
  while (at != end_ && at != next_ + kSmall && *at == ' ') ++at;
  if (static_cast<std::size_t>(end_ - at) < word.size()) return false;
  return std::equal(word.begin(), word.end(), at,
                    [](char wanted, char c) { return to_capital(c) == wanted; });
}

std::string_view NastranStrays::behind(std::string_view line) const {
  const auto found = behind_.find(line.data());
  return found == behind_.end() ? std::string_view() : found->second;
}

bool NastranStrays::follows(std::string_view line, std::string_view before) {
  const std::string_view key = key_of_name(line);
  const std::string_view mark = mark_of(before);
  return key.empty() || key == mark || (!mark.empty() && key == mark.substr(1));
}

void NastranStrays::add(const char* begin, const char* end) {
  std::unordered_map<std::string_view, const char*> owners;  // by what their marks mean
  std::vector<std::string_view> apart;
  const auto own = [&](std::string_view line) {
    const std::string_view mark = mark_of(line);
    if (mark.empty()) return;
    for (const std::string_view key : {mark, mark.substr(1)}) owners.try_emplace(key, line.data());
  };
  NastranLines lines(begin, end);
  std::string_view before;
  bool is_apart = false;
  while (!lines.at_end()) {
    const char first = lines.initial();
    const std::string_view line = lines.line();
    if (is_blank_text(without_comment(line))) continue;
    const bool is_named = (first == '+' || first == '*') && !key_of_name(line).empty();
    // What follows one of these by its name is one, too.
    is_apart = is_named && (is_apart || !follows(line, before));
    if (is_apart) apart.push_back(line);
    if (is_apart || !is_named) own(before);
    before = line;
  }
  own(before);
  std::unordered_map<const char*, std::string_view> behind;
  std::unordered_set<const char*> in_chain;  // their owner may be one of them
  for (const std::string_view line : apart) {
    const auto owner = owners.find(key_of_name(line));
    if (owner != owners.end()) behind.try_emplace(owner->second, line);
    in_chain.insert(line.data());
  }
  // From each card on: those that only continue each other are left as they stand.
  for (const auto& each : behind) {
    const char* card = each.first;
    if (in_chain.contains(card)) continue;
    for (auto at = behind.find(card); at != behind.end(); at = behind.find(at->second.data())) {
      behind_.insert(*at);
      places_.insert(at->second.data());
    }
  }
}

void NastranLines::skip_comments() {
  while (!at_end()) {
    const char first = initial();
    if (first != '$' && first != '\t' && first != '\r' && first != '\0') return;
    NastranLines ahead = *this;
    if (!is_blank_text(without_comment(ahead.line()))) return;
    *this = ahead;
  }
}

bool NastranLines::continues() const {
  if (at_end()) return false;
  const char first = initial();
  if (first >= 'A' && first <= 'Z') return false;
  if (*next_ == '+' || *next_ == '*') return true;
  NastranLines ahead = *this;
  const std::string_view line = without_comment(ahead.line());
  return is_blank_text(first_field(line)) || is_blank_text(line.substr(0, kSmall));
}

void NastranLines::read(NastranCardText& card) {
  const char* begin = next_;
  card.fields.clear();
  card.comments.clear();
  card.strays.clear();
  card.has_end_comments = false;
  std::string_view present = line();
  card.name = nastran_name(present);
  card.text = present;
  if (is_stray(begin)) card.name.clear();
  if (card.name.empty() && (is_stray(begin) || is_blank_text(without_comment(present)))) return;
  for (;;) {
    const std::string_view stray =
        strays_ == nullptr ? std::string_view() : strays_->behind(present);
    if (!stray.empty()) {
      split(card, present, first_field(without_comment(stray)));
      card.strays.push_back(present = stray);
      continue;
    }
    const char first = at_end() ? '\0' : initial();
    const bool ends = at_end() || is_stray(next_) || !card.strays.empty();
    if (ends || (first >= 'A' && first <= 'Z')) {  // most often: a card of one line
      split(card, present, {});
      break;
    }
    NastranLines ahead = *this;
    ahead.skip_comments();
    const bool goes_on = ahead.continues();
    NastranLines next = ahead;
    const std::string_view following = goes_on ? next.line() : std::string_view();
    split(card, present, first_field(without_comment(following)));
    if (!goes_on) break;
    while (next_ != ahead.next_) card.comments.push_back(line());
    present = following;
    *this = next;
  }
  card.text = {begin, static_cast<std::size_t>(next_ - begin)};
}

std::string nastran_name(std::string_view line) {
  std::size_t begin = 0;
  while (begin < std::min(kSmall, line.size()) && line[begin] == ' ') ++begin;
  if (begin == kSmall) return {};
  // A name may stand behind blanks, in free fields also beyond the first eight columns.
  const bool is_free = begin > 0 && line.find(',') != std::string_view::npos;
  const std::string_view rest = line.substr(begin, is_free ? kSmall : kSmall - begin);
  std::string name;
  for (const char c : rest) {
    const bool ends = c == ' ' || c == ',' || c == '*' || c == '$' || (c >= '\t' && c <= '\r');
    if (ends) break;
    name += to_capital(c);
  }
  return name;
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
