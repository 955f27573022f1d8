// SPDX-License-Identifier: MIT
// The data lines below a keyword of an Abaqus deck, field by field.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "kernel/formats/inp_lines.h"

namespace tetmend::formats {

/// The fields of a block's data lines, parted by commas. Comments and empty lines are passed over.
class InpFields {
 public:
  explicit InpFields(const InpBlock& block);

  /// Goes to the next line; false at the end.
  bool next_line();
  /// True if this line has another field.
  bool more() const { return next_ != nullptr; }
  /// The next field without the blanks around it; empty if there is none.
  std::string_view field();
  /// The next field; where the line has none, that of the next line.
  std::string_view field_of_lines(std::string_view what);
  std::int64_t integer(std::string_view what, bool of_lines = false);
  /// Empty counts as 0.
  double real(std::string_view what);
  /// The present line without its line break.
  std::string_view line() const { return {line_, static_cast<std::size_t>(line_end_ - line_)}; }
  /// What is left of the line, from the comma on.
  std::string_view rest() const;
  const char* place() const { return place_; }
  /// "deck.inp:7", of the present line.
  std::string line_place() const;
  [[noreturn]] void fail(std::string_view reason) const;

 private:
  void refuse_cut(std::string_view text, std::string_view what) const;

  const InputFile& file_;
  const char* position_;
  const char* end_;
  const char* line_;
  const char* line_end_;
  const char* next_ = nullptr;
  const char* place_;
};

/// The value of a field that is nothing but an integer; false if it is none.
bool to_integer(std::string_view text, std::int64_t& value);

}  // namespace tetmend::formats
