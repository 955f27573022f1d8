// SPDX-License-Identifier: MIT
// Words and numbers of a text file, each checked when it is read; errors carry the file and the
// line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "kernel/formats/input_file.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Reads a file word by word; words are parted by white space. `what` names the expected thing in
/// errors ("a vertex number").
class TextReader {
 public:
  /// No character opens a comment: a line break is white space before it can be looked at as a
  /// comment.
  static constexpr char kNoComments = '\n';

  /// From `comment` to the end of the line text is passed over. A byte order mark of UTF-8 is
  /// passed over too.
  TextReader(const InputFile& file, char comment);

  /// From now on errors name a byte: lines mean nothing in a file whose numbers are binary.
  void locate_errors_by_byte() { by_byte_ = true; }

  /// The next word; empty at the end of the file.
  std::string_view word();
  /// The next word of this line; empty at its end.
  std::string_view word_on_line();
  /// The next word, which must be there.
  std::string_view expect_word(std::string_view what);

  /// An integer from `low` to `high`. "1.0" is none.
  std::int64_t integer(std::string_view what, std::int64_t low, std::int64_t high);
  /// A finite number; a Fortran exponent (1.5D+00) is understood.
  double real(std::string_view what);
  Label label(std::string_view what) {
    return static_cast<Label>(integer(what, INT32_MIN, INT32_MAX));
  }
  /// A count of entries that take at least `bytes_each` bytes each, refused if the rest of the file
  /// cannot hold so many: callers take memory for it.
  std::size_t count(std::string_view what, std::size_t bytes_each);

  /// True when nothing but blanks and a comment is left on this line.
  bool at_line_end();
  /// True when nothing but white space and comments is left in the file.
  bool at_end();
  /// Goes behind the next line break, and gives what was passed over.
  std::string_view skip_line();
  /// The next `size` bytes, whatever they are.
  const char* bytes(std::size_t size, std::string_view what);
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - next_); }

  /// Thrown instead of an Error by a reader on trial.
  struct TrialFailed {};
  /// Another reader of the same file, from `position` on. Where this one throws an Error, which
  /// takes the time to find the line, that one throws TrialFailed.
  TextReader trial(const char* position) const {
    TextReader other = *this;
    other.on_trial_ = true;
    other.seek(position);
    return other;
  }
  /// The first beginning of a line at least `distance` bytes from here, or the end of the file.
  const char* line_after(std::size_t distance) const;
  /// True if nothing but white space comes before `end`.
  bool ends_at(const char* end) const;

  const char* position() const { return next_; }
  void seek(const char* position) { next_ = position; }
  /// Where the word read last begins.
  const char* last_word() const { return word_; }

  /// "FILE:LINE" or "FILE: byte N".
  std::string place_of(const char* where) const {
    return by_byte_ ? file_.byte_place(where) : file_.line_place(where);
  }
  /// Throws Error about the word read last.
  [[noreturn]] void fail(std::string_view reason) const { fail_at(word_, reason); }
  [[noreturn]] void fail_at(const char* where, std::string_view reason) const;

 private:
  void skip_space();
  bool ends_word(char c) const;
  const char* end_of_word() const;
  std::string_view slow_number(std::string_view what);
  std::int64_t slow_integer(std::string_view what, std::int64_t low, std::int64_t high);
  [[noreturn]] void fail_range(std::string_view what, std::int64_t low, std::int64_t high) const;
  double slow_real(std::string_view what);

  const InputFile& file_;
  const char* end_;
  const char* next_;
  const char* word_;
  char comment_;
  bool by_byte_ = false;
  bool on_trial_ = false;
};

}  // namespace tetmend::formats
