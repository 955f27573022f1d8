// SPDX-License-Identifier: MIT
// Numbers for points and elements that a deck has none for yet.
#include "kernel/formats/new_numbers.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <functional>

#include "kernel/error.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {

NewNumbers::NewNumbers(std::int64_t most, std::span<const std::int64_t> limits, Taken taken)
    : last_(most), limit_(limits.back()), taken_(std::move(taken)) {
  const auto limit = std::lower_bound(limits.begin(), limits.end(), most);
  if (limit != limits.end()) limit_ = *limit;
}

std::int64_t NewNumbers::next() {
  if (!is_between_ && last_ >= limit_) look_between();
  while (!ranges_.empty() && ranges_.back().first <= last_ + 1) {
    last_ = std::max(last_, ranges_.back().second);
    ranges_.pop_back();
    if (last_ >= limit_) throw Error("no number is left for new points or elements of the deck");
  }
  return ++last_;
}

void NewNumbers::look_between() {
  is_between_ = true;
  ranges_ = taken_();
  ranges_.push_back({limit_, limit_});
  std::sort(ranges_.begin(), ranges_.end(), std::greater<>());
  last_ = 0;
}

namespace {

/// False if the word is no number that a point or element may have.
bool to_number(std::string_view word, std::int64_t& number) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() && number > 0;
}

/// Numbers of one line of an Abaqus deck; of a node in an instance, "PART-1.7", that in its part.
std::vector<std::int64_t> numbers_of_line(std::string_view line) {
  constexpr std::string_view kBetween = " \t\r\v\f,=";
  std::vector<std::int64_t> numbers;
  while (!line.empty()) {
    line.remove_prefix(std::min(line.find_first_not_of(kBetween), line.size()));
    std::string_view word = line.substr(0, line.find_first_of(kBetween));
    line.remove_prefix(word.size());
    const bool is_name = !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0;
    if (is_name) word.remove_prefix(std::min(word.rfind('.'), word.size() - 1) + 1);
    if (std::int64_t number = 0; to_number(word, number)) numbers.push_back(number);
  }
  return numbers;
}

bool has_parameter(std::string_view keyword_line, std::string_view name) {
  while (!keyword_line.empty()) {
    const std::size_t comma = std::min(keyword_line.find(','), keyword_line.size());
    if (inp_key(keyword_line.substr(0, comma)) == name) return true;
    keyword_line.remove_prefix(std::min(comma + 1, keyword_line.size()));
  }
  return false;
}

}  // namespace

void add_inp_numbers(std::string_view text, std::vector<NewNumbers::Range>& ranges) {
  bool is_keyword = false;
  bool gives_ranges = false;
  while (!text.empty()) {
    const std::string_view line = trimmed(text.substr(0, text.find('\n')));
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    if (line.empty() || line.starts_with("**")) continue;
    if (line[0] == '*') gives_ranges = false;
    is_keyword = is_keyword || line[0] == '*';
    if (is_keyword) gives_ranges = gives_ranges || has_parameter(line, "GENERATE");
    const std::vector<std::int64_t> numbers = numbers_of_line(line);
    if (!is_keyword && gives_ranges && numbers.size() > 1) {
      ranges.emplace_back(numbers[0], std::max(numbers[0], numbers[1]));
    } else {
      for (const std::int64_t number : numbers) ranges.emplace_back(number, number);
    }
    is_keyword = is_keyword && line.back() == ',';  // and goes on
  }
}

void add_nastran_numbers(std::string_view cards, std::vector<NewNumbers::Range>& ranges) {
  NastranLines lines(cards.data(), cards.data() + cards.size());
  NastranCardText card;
  while (!lines.at_end()) {
    lines.read(card);
    bool is_range = false;
    for (const std::string_view field : card.fields) {
      std::int64_t number = 0;
      const bool is_number = nastran_integer(field, number) && number > 0;
      if (is_number && is_range && !ranges.empty()) {
        ranges.back().second = std::max(ranges.back().second, number);
      } else if (is_number) {
        ranges.emplace_back(number, number);
      }
      if (!field.empty()) is_range = inp_key(field) == "THRU";
    }
  }
}

}  // namespace tetmend::formats
