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

NewNumbers numbers_beside(std::span<const std::int64_t> known, std::span<const NumberRange> of_file,
                          std::span<const std::int64_t> limits, std::int64_t most,
                          NewNumbers::Taken more) {
  for (const std::int64_t number : known) most = std::max(most, number);
  if (!of_file.empty()) most = std::max(most, of_file.back().second);
  return {most, limits, [known, of_file, more = std::move(more)] {
            std::vector<NumberRange> taken;
            if (more) taken = more();
            for (const std::int64_t number : known) taken.emplace_back(number, number);
            taken.insert(taken.end(), of_file.begin(), of_file.end());
            return taken;
          }};
}

void complete(std::vector<std::int64_t>& numbers, NewNumbers& next) {
  for (std::int64_t& number : numbers) {
    if (number <= 0) number = next.next();
  }
}

namespace {

void add_ranges(const std::vector<std::int64_t>& numbers, std::vector<NumberRange>& ranges) {
  for (const std::int64_t number : numbers) {
    if (number <= 0) continue;
    if (!ranges.empty() && ranges.back().second == number - 1) {
      ranges.back().second = number;
    } else {
      ranges.emplace_back(number, number);
    }
  }
}

/// In ascending order, and as few as may be.
void merge(std::vector<NumberRange>& ranges) {
  if (!std::is_sorted(ranges.begin(), ranges.end())) std::sort(ranges.begin(), ranges.end());
  std::size_t count = 0;
  for (const NumberRange& range : ranges) {
    if (count > 0 && range.first - 1 <= ranges[count - 1].second) {
      ranges[count - 1].second = std::max(ranges[count - 1].second, range.second);
    } else {
      ranges[count++] = range;
    }
  }
  ranges.resize(count);
  ranges.shrink_to_fit();
}

}  // namespace

void note_taken_numbers(MeshData& mesh) {
  add_ranges(mesh.point_numbers, mesh.taken_point_numbers);
  merge(mesh.taken_point_numbers);
  std::vector<NumberRange>& of_elements = mesh.taken_element_numbers;
  for (const auto* numbers : {&mesh.tet_numbers, &mesh.triangle_numbers, &mesh.edge_numbers})
    add_ranges(*numbers, of_elements);
  for (const OtherElements& others : mesh.other_elements) add_ranges(others.numbers, of_elements);
  merge(of_elements);
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

void add_inp_numbers(std::string_view text, std::vector<NumberRange>& ranges) {
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

void add_nastran_numbers(std::string_view cards, std::vector<NumberRange>& ranges) {
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
