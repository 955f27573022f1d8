// SPDX-License-Identifier: MIT
// Words that users choose: what is one, and what somebody who mistyped one may have meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tetmend {

/// Lower case letters, digits and underscores, first a letter: what fits any script and shell.
bool is_name(std::string_view text);

/// The candidate of the fewest letters that are to be added, left out, replaced or swapped with the
/// next one; of equal ones the first. Empty where that is more than a third of the word: then it is
/// rather another word. Cost: quadratic in the lengths.
std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

/// The same behind a list of what is valid: "; did you mean 'WORD'?", or nothing.
/// @param valid words with ", " between them
std::string guess_of(std::string_view word, std::string_view valid);

/// ": did you mean 'WORD'?", or nothing.
std::string guess(std::string_view word, std::span<const std::string> candidates);

}  // namespace tetmend
