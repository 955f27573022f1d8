// SPDX-License-Identifier: MIT
// The exceptions of tetmend: something in the world outside (a file, an argument) is wrong.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <tetmend/api.h>
#include <tetmend/language.h>

namespace tetmend {

/// Thrown for bad input and failed output. `what()` is one line that a user can act on: the file,
/// the line or byte where it went wrong, the offending word and what was expected. Bugs are
/// assertions and refusals of operators are `Verdict`s.
class TETMEND_API Error : public std::runtime_error {
 public:
  /// @param message one line, with the place
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

/// An option has a value that makes no sense, or none for this mesh.
class TETMEND_API OptionError : public Error {
 public:
  /// @param message begins with the name of the option
  OptionError(std::string option, const std::string& message)
      : Error(message), option_(std::move(option)) {}
  /// As in `Options`: "time_limit".
  const std::string& option() const { return option_; }

 private:
  std::string option_;
};

}  // namespace tetmend
