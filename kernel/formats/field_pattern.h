// SPDX-License-Identifier: MIT
// Which fields of a line are numbers of points, as a word: "--(p)" are all but the first two.
#pragma once

#include <cstddef>
#include <string_view>

namespace tetmend::formats {

/// 'p' stands for a point and '-' for any other field; what is in parentheses, at the end, is
/// repeated. Fields behind the end are other ones.
class FieldPattern {
 public:
  constexpr explicit FieldPattern(std::string_view text)
      : head_(text.substr(0, text.find('('))), rest_(text.substr(head_.size())) {
    if (rest_.empty()) return;
    rest_.remove_prefix(1);
    rest_.remove_suffix(1);
  }

  constexpr bool is_point(std::size_t field) const {
    if (field < head_.size()) return head_[field] == 'p';
    return !rest_.empty() && rest_[(field - head_.size()) % rest_.size()] == 'p';
  }

 private:
  std::string_view head_, rest_;
};

}  // namespace tetmend::formats
