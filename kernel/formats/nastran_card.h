// SPDX-License-Identifier: MIT
// One card of Nastran's bulk data: its fields, in whichever of the three forms they stand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/input_file.h"

namespace tetmend::formats {

/// A card with its continuations. Fields are views into the file.
struct NastranCardText {
  std::string name;                      ///< in capitals, without '*'
  std::string_view text;                 ///< all lines, with the last line break
  std::vector<std::string_view> fields;  ///< behind the name, trimmed

  std::string_view field(std::size_t i) const { return i < fields.size() ? fields[i] : ""; }
};

/// Goes through the bulk card by card.
class NastranLines {
 public:
  NastranLines(const char* begin, const char* end) : next_(begin), end_(end) {}

  bool at_end() const { return next_ == end_; }
  const char* position() const { return next_; }
  /// The next line, with its break.
  std::string_view line();
  /// True if the next line goes on with the card before.
  bool continues() const;
  /// The card that begins here.
  void read(NastranCardText& card);

 private:
  const char* next_;
  const char* end_;
};

/// The name of the card that a line begins, in capitals; empty for a comment or a blank line.
std::string nastran_name(std::string_view line);

std::string_view trimmed_field(std::string_view text);

/// False if the field is no integer.
bool nastran_integer(std::string_view field, std::int64_t& value);
/// Reals may lack their 'E': "1.5-3". False if the field is no number or not finite.
bool nastran_real(std::string_view field, double& value);

}  // namespace tetmend::formats
