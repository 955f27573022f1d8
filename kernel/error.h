// SPDX-License-Identifier: MIT
// The one exception of tetmend: something in the world outside (a file, an argument) is wrong.
#pragma once

#include <stdexcept>
#include <string>

namespace tetmend {

/// Thrown for bad input and failed output. `what()` is one line that a user can act on: the file,
/// the line or byte where it went wrong, the offending word and what was expected. A bug is an
/// assertion, and the refusal of an operator a `Verdict`.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace tetmend
