// SPDX-License-Identifier: MIT
// Words and numbers of a text file, each checked when it is read; errors carry the file and the
// line.
#include "kernel/formats/text_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

namespace tetmend::formats {
namespace {

bool is_space(char c) {
  return c == ' ' || static_cast<unsigned char>(c - '\t') < 5;
}

bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') < 10;
}

}  // namespace

TextReader::TextReader(const InputFile& file, char comment)
    : file_(file), end_(file.end()), next_(file.begin()), word_(file.begin()), comment_(comment) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (std::string_view(next_, bytes_left()).starts_with(kMark)) next_ += kMark.size();
}

bool TextReader::ends_word(char c) const {
  return is_space(c) || c == comment_;
}

// The zero byte behind the file is neither space nor comment, so the scans below end there without
// a bound.
void TextReader::skip_space() {
  for (;;) {
    while (is_space(*next_)) ++next_;
    if (*next_ != comment_) return;
    skip_line();
  }
}

const char* TextReader::end_of_word() const {
  const char* end = next_;
  while (end != end_ && !ends_word(*end)) ++end;
  return end;
}

std::string_view TextReader::word() {
  skip_space();
  word_ = next_;
  next_ = end_of_word();
  return {word_, static_cast<std::size_t>(next_ - word_)};
}

std::string_view TextReader::word_on_line() {
  if (at_line_end()) return {};
  return word();
}

std::string_view TextReader::expect_word(std::string_view what) {
  const std::string_view found = word();
  if (found.empty()) fail(fmt::format("the file ends where {} is expected", what));
  return found;
}

bool TextReader::at_line_end() {
  while (*next_ != '\n' && is_space(*next_)) ++next_;
  word_ = next_;
  return next_ == end_ || *next_ == '\n' || *next_ == comment_;
}

bool TextReader::at_end() {
  skip_space();
  word_ = next_;
  return next_ == end_;
}

std::string_view TextReader::skip_line() {
  const char* begin = next_;
  const void* newline = bytes_left() == 0 ? nullptr : std::memchr(next_, '\n', bytes_left());
  const char* stop = newline == nullptr ? end_ : static_cast<const char*>(newline);
  next_ = stop == end_ ? end_ : stop + 1;
  return {begin, static_cast<std::size_t>(stop - begin)};
}

const char* TextReader::line_after(std::size_t distance) const {
  if (distance >= bytes_left()) return end_;
  // A line that begins exactly there has its break one byte before.
  const char* from = next_ + distance - (distance > 0 ? 1 : 0);
  const void* newline = std::memchr(from, '\n', static_cast<std::size_t>(end_ - from));
  return newline == nullptr ? end_ : static_cast<const char*>(newline) + 1;
}

bool TextReader::ends_at(const char* end) const {
  return next_ <= end && std::all_of(next_, end, is_space);
}

const char* TextReader::bytes(std::size_t size, std::string_view what) {
  word_ = next_;
  if (size > bytes_left()) {
    fail(fmt::format(
        "{} take {} bytes, but only {} are left: the file is truncated or a count is wrong", what,
        size, bytes_left()));
  }
  next_ += size;
  return word_;
}

// Much of a short run is spent here: the loops look at no members.
std::int64_t TextReader::integer(std::string_view what, std::int64_t low, std::int64_t high) {
  const char* p = next_;
  while (is_space(*p)) ++p;
  word_ = p;
  const bool negative = *p == '-';
  if (negative) ++p;
  const char* digits = p;
  std::uint64_t size = 0;  // wraps round where there are too many digits
  for (; is_digit(*p); ++p) size = 10 * size + static_cast<unsigned char>(*p - '0');
  constexpr std::ptrdiff_t kAlwaysFits = 18;
  if (p == digits || p - digits > kAlwaysFits || !ends_word(*p)) {
    return slow_integer(what, low, high);
  }
  next_ = p;
  const auto value = static_cast<std::int64_t>(negative ? 0 - size : size);
  if (value < low || value > high) fail_range(what, low, high);
  return value;
}

// Apart from integer(): its strings would cost each number the set-up of a stack frame.
void TextReader::fail_range(std::string_view what, std::int64_t low, std::int64_t high) const {
  const std::string_view word(word_, static_cast<std::size_t>(next_ - word_));
  fail(fmt::format("{} is out of range: expected {}, {} to {}", in_quotes(word), what, low, high));
}

double TextReader::real(std::string_view what) {
  skip_space();
  double value = 0;
  const auto [stop, error] = fast_float::from_chars(next_, end_, value);
  if (error == std::errc() && ends_word(*stop) && std::isfinite(value)) {
    word_ = next_;
    next_ = stop;
    return value;
  }
  return slow_real(what);
}

// The whole word where a number is expected. A number that touches the end of the file may have
// lost its last digits.
std::string_view TextReader::slow_number(std::string_view what) {
  const std::string_view found = expect_word(what);
  if (next_ == end_) {
    fail(fmt::format(
        "the file ends right behind {}: expected {} and a line break; the file seems truncated",
        in_quotes(found), what));
  }
  return found;
}

std::int64_t TextReader::slow_integer(std::string_view what, std::int64_t low, std::int64_t high) {
  const std::string_view found = slow_number(what);
  const char* first = found.data();
  const char* last = first + found.size();
  if (*first == '+' && found.size() > 1 && is_digit(first[1])) ++first;
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(first, last, value);
  if (error == std::errc::result_out_of_range && stop == last) {
    fail(fmt::format("{} is out of range: expected {}", in_quotes(found), what));
  }
  if (error != std::errc() || stop != last) {
    fail(fmt::format("{} is not an integer: expected {}", in_quotes(found), what));
  }
  if (value < low || value > high) fail_range(what, low, high);
  return value;
}

double TextReader::slow_real(std::string_view what) {
  const std::string_view found = slow_number(what);
  std::string text(found.substr(0, 1000));
  if (text.size() > 1 && text[0] == '+' && (is_digit(text[1]) || text[1] == '.')) text.erase(0, 1);
  std::replace(text.begin(), text.end(), 'D', 'e');
  std::replace(text.begin(), text.end(), 'd', 'e');
  double value = 0;
  const char* last = text.data() + text.size();
  const auto [stop, error] = fast_float::from_chars(text.data(), last, value);
  if (error == std::errc::invalid_argument || stop != last) {
    fail(fmt::format("{} is not a number: expected {}", in_quotes(found), what));
  }
  if (!std::isfinite(value)) {
    fail(fmt::format("{} is not a finite number: expected {}", in_quotes(found), what));
  }
  return value;
}

std::size_t TextReader::count(std::string_view what, std::size_t bytes_each) {
  const std::string number = fmt::format("the number of {}", what);
  const auto value = static_cast<std::size_t>(integer(number, 0, INT64_MAX));
  if (value > (bytes_left() + 1) / bytes_each) {
    fail(fmt::format(
        "{} {} cannot fit into the {} bytes that are left: the count is wrong or the file is "
        "truncated",
        value, what, bytes_left()));
  }
  return value;
}

void TextReader::fail_at(const char* where, std::string_view reason) const {
  if (on_trial_) throw TrialFailed();
  if (by_byte_) file_.fail_at_byte(where, reason);
  file_.fail_at_line(where, reason);
}

}  // namespace tetmend::formats
