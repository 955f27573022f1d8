// SPDX-License-Identifier: MIT
#include "kernel/formats/inp_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

namespace tetmend::formats {

InpFields::InpFields(const InpBlock& block)
    : file_(block.input != nullptr ? *block.input : *block.file),
      position_(block.input != nullptr ? block.input->begin() : block.data),
      end_(block.input != nullptr ? block.input->end() : block.end),
      line_(position_),
      line_end_(position_),
      place_(position_) {}

bool InpFields::next_line() {
  while (position_ != end_) {
    line_ = position_;
    line_end_ = inp_line_end(line_, end_);
    position_ = line_end_ == end_ ? end_ : line_end_ + 1;
    const char* first = line_;
    while (first != line_end_ && is_inp_blank(*first)) ++first;
    if (first == line_end_ || (line_end_ - first > 1 && first[0] == '*' && first[1] == '*')) {
      continue;
    }
    place_ = next_ = first;
    return true;
  }
  place_ = end_;
  next_ = nullptr;
  return false;
}

std::string_view InpFields::field() {
  if (next_ == nullptr) return {};
  const char* first = next_;
  while (first != line_end_ && is_inp_blank(*first)) ++first;
  place_ = first;
  const char* stop = first;
  bool quoted = false;
  while (stop != line_end_ && (*stop != ',' || quoted)) quoted ^= *stop++ == '"';
  next_ = stop == line_end_ ? nullptr : stop + 1;
  // A comma at the end of a line is followed by nothing.
  if (next_ != nullptr) {
    const char* rest = next_;
    while (rest != line_end_ && is_inp_blank(*rest)) ++rest;
    if (rest == line_end_) next_ = nullptr;
  }
  while (stop != first && is_inp_blank(stop[-1])) --stop;
  return {first, static_cast<std::size_t>(stop - first)};
}

std::string_view InpFields::field_of_lines(std::string_view what) {
  if (next_ == nullptr && !next_line()) {
    fail(fmt::format("the data lines end where {} is expected", what));
  }
  return field();
}

bool to_integer(std::string_view text, std::int64_t& value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && stop == text.data() + text.size() && !text.empty();
}

std::int64_t InpFields::integer(std::string_view what, bool of_lines) {
  const std::string_view text = of_lines ? field_of_lines(what) : field();
  refuse_cut(text, what);
  std::int64_t value = 0;
  if (!to_integer(text, value)) {
    fail(fmt::format("{} is not an integer: expected {}", in_quotes(text), what));
  }
  if (value < 0 || value > kInpGreatestNumber) {
    fail(fmt::format("{} is out of range: expected {}", in_quotes(text), what));
  }
  return value;
}

double InpFields::real(std::string_view what) {
  std::string_view text = field();
  refuse_cut(text, what);
  if (text.empty()) return 0;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  auto result = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc() && result.ptr != text.data() + text.size()) {
    std::string fortran(text.substr(0, 1000));
    std::replace(fortran.begin(), fortran.end(), 'D', 'e');
    std::replace(fortran.begin(), fortran.end(), 'd', 'e');
    const char* last = fortran.data() + fortran.size();
    result = fast_float::from_chars(fortran.data(), last, value);
    if (result.ptr != last) result.ec = std::errc::invalid_argument;
  }
  if (result.ec == std::errc::invalid_argument) {
    fail(fmt::format("{} is not a number: expected {}", in_quotes(text), what));
  }
  if (!std::isfinite(value)) {
    fail(fmt::format("{} is not a finite number: expected {}", in_quotes(text), what));
  }
  return value;
}

// A number that touches the end of the file may have lost its last digits.
void InpFields::refuse_cut(std::string_view text, std::string_view what) const {
  if (text.data() == nullptr || text.data() + text.size() != file_.end()) return;
  fail(fmt::format(
      "the file ends right behind {}: expected {} and a line break; the file seems truncated",
      in_quotes(text), what));
}

std::string_view InpFields::rest() const {
  if (next_ == nullptr) return {};
  const char* stop = line_end_;
  while (stop != next_ && is_inp_blank(stop[-1])) --stop;
  return {next_ - 1, static_cast<std::size_t>(stop - next_ + 1)};
}

std::string InpFields::line_place() const {
  return file_.line_place(place_);
}

void InpFields::fail(std::string_view reason) const {
  file_.fail_at_line(place_, reason);
}

}  // namespace tetmend::formats
