// SPDX-License-Identifier: MIT
// Which fields of a keyword of LS-DYNA are nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace tetmend::formats {

inline constexpr std::uint32_t kAllFields = ~0U;

/// Walks over the lines of a keyword. Source: LS-DYNA Keyword User's Manual, volume I.
class LsDynaNodeFields {
 public:
  /// @param keyword  in capitals, without '*'
  explicit LsDynaNodeFields(std::string_view keyword);

  /// All whole numbers may be nodes: the keyword is none that is known here.
  bool are_all() const { return form_ == nullptr; }
  /// Of the next line: bit i for field i; or kAllFields.
  std::uint32_t of_line(std::span<const std::string_view> fields);

  /// What is known of a keyword.
  struct Form {
    std::string_view keyword;
    std::uint32_t first;      ///< of the first line of each entry
    unsigned lines = 1;       ///< of an entry; the others have no nodes
    std::uint32_t after = 0;  ///< of a line that follows where `is_longer`
    bool (*is_longer)(std::span<const std::string_view> fields) = nullptr;
  };

 private:
  const Form* form_ = nullptr;
  unsigned line_ = 0;        // of the entry
  bool is_heading_ = false;  // comes first
  bool is_longer_ = false;   // the line that comes
};

}  // namespace tetmend::formats
