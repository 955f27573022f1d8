// SPDX-License-Identifier: MIT
// Numbers for points and elements that a deck has none for yet.
#include "kernel/formats/new_numbers.h"

#include <algorithm>
#include <charconv>
#include <functional>

#include "kernel/error.h"

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

void add_numbers_of(std::string_view text, std::vector<NewNumbers::Range>& ranges) {
  constexpr std::string_view kBetween = " \t\r\n\v\f,";
  bool is_range = false;
  while (!text.empty()) {
    const std::size_t first = std::min(text.find_first_not_of(kBetween), text.size());
    text.remove_prefix(first);
    const std::string_view word = text.substr(0, text.find_first_of(kBetween));
    text.remove_prefix(word.size());
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool is_number = error == std::errc() && end == word.data() + word.size() && number > 0;
    if (is_number && is_range && !ranges.empty()) {
      ranges.back().second = std::max(ranges.back().second, number);
    } else if (is_number) {
      ranges.push_back({number, number});
    }
    is_range = word == "THRU" || word == "thru";
  }
}

}  // namespace tetmend::formats
