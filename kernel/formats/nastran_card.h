// SPDX-License-Identifier: MIT
// One card of Nastran's bulk data: its fields, in whichever of the three forms they stand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "kernel/formats/input_file.h"

namespace tetmend::formats {

/// A card with its continuations. All are views into the file.
struct NastranCardText {
  std::string name;                        ///< in capitals, without '*'
  std::string_view text;                   ///< all lines, with the last line break
  std::vector<std::string_view> fields;    ///< behind the name, trimmed
  std::vector<std::string_view> comments;  ///< lines of these that stand within the card
  std::vector<std::string_view> strays;    ///< continuations that stand elsewhere
  bool has_end_comments = false;           ///< behind the fields of its lines

  std::string_view field(std::size_t i) const { return i < fields.size() ? fields[i] : ""; }
};

/// Continuations that do not follow the line that they continue: the marks at the end of the one and
/// the beginning of the other tell which belong together.
class NastranStrays {
 public:
  /// Those of some lines.
  void add(const char* begin, const char* end);
  bool is_empty() const { return behind_.empty(); }
  /// True if the line here is the continuation of another than the one before it.
  bool is_stray(const char* line) const { return places_.contains(line); }
  /// The line that continues this one; empty: none but the next.
  std::string_view behind(std::string_view line) const;

  /// False if `line`, a continuation with a name, is none of the line `before`.
  static bool follows(std::string_view line, std::string_view before);

 private:
  std::unordered_map<const char*, std::string_view> behind_;
  std::unordered_set<const char*> places_;
};

/// Goes through the bulk card by card.
class NastranLines {
 public:
  NastranLines(const char* begin, const char* end, const NastranStrays* strays = nullptr)
      : next_(begin), end_(end), strays_(strays) {}

  bool at_end() const { return next_ == end_; }
  const char* position() const { return next_; }
  /// The next line, with its break.
  std::string_view line();
  /// The letter that the next line begins with, as a capital; else what stands there, and '\0' where
  /// the first of its eight columns that are a field have nothing.
  char initial() const;
  /// True if the next line begins with this word, whatever the case. `word` is in capitals.
  bool begins_with(std::string_view word) const;
  /// The card that begins here, with its continuations, also behind comments and blank lines. One of
  /// these is a card of its own, without a name or fields.
  void read(NastranCardText& card);

 private:
  /// Goes to the next line that says something.
  void skip_comments();
  bool continues() const;
  bool is_stray(const char* line) const { return strays_ != nullptr && strays_->is_stray(line); }

  const char* next_;
  const char* end_;
  const NastranStrays* strays_ = nullptr;  // null: there are none
};

/// The name of the card that a line begins, in capitals; empty for a comment, a blank line and a
/// continuation without a name.
std::string nastran_name(std::string_view line);

std::string_view trimmed_field(std::string_view text);

/// False if the field is no integer.
bool nastran_integer(std::string_view field, std::int64_t& value);
/// Reals may lack their 'E': "1.5-3". False if the field is no number or not finite.
bool nastran_real(std::string_view field, double& value);

}  // namespace tetmend::formats
