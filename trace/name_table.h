// SPDX-License-Identifier: MIT
// The names in a trace, each with a number.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tetmend {

/// Numbers are given in the order of arrival; number 0 is the empty name.
class NameTable {
 public:
  NameTable() { number_of(""); }

  /// A new name gets the next number. Cost: logarithmic, because a file decides how many there are.
  std::uint32_t number_of(std::string_view name) {
    const auto found = numbers_.find(name);
    if (found != numbers_.end()) return found->second;
    const auto number = static_cast<std::uint32_t>(names_.size());
    names_.emplace_back(name);
    numbers_.emplace(name, number);
    return number;
  }
  /// Precondition: `number` came from number_of().
  std::string_view operator[](std::uint32_t number) const { return names_[number]; }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::uint32_t, std::less<>> numbers_;
};

}  // namespace tetmend
