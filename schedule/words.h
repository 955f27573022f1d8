// SPDX-License-Identifier: MIT
// The language of schedules: the words that a script can call, and what each of them takes.
#pragma once

#include <span>
#include <string_view>

#include "ops/parameters.h"

namespace tetmend {

/// A named argument that is no number: "on", "edges".
struct WordField {
  std::string_view name;
  std::string_view takes;
  std::string_view initial;  ///< the default, as a script would write it
  std::string_view help;
};

struct WordInfo {
  std::string_view name;
  std::string_view usage;  ///< how a script writes it
  std::string_view help;
  std::span<const WordField> fields = {};
  std::span<const ParameterSpec> numbers = {};
  /// Its arguments may also be parameters of these operators, separated by blanks.
  std::string_view operators = {};
};

/// All words, in the order in which one would explain them.
std::span<const WordInfo> schedule_words();

/// Precondition: there is such a word.
const WordInfo& find_word(std::string_view name);

}  // namespace tetmend
