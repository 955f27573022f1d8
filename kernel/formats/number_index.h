// SPDX-License-Identifier: MIT
// From the numbers that a file gives to nodes or elements, in any order, to their places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/formats/gmsh_tags.h"

namespace tetmend::formats {

class NumberIndex {
 public:
  static constexpr std::uint32_t kNone = GmshTags::kNone;

  NumberIndex() = default;
  /// Calls fail(i) for the second thing that has a number; it must not return. Cost: that of sorting.
  template <class Fail>
  NumberIndex(const std::vector<std::int64_t>& numbers, const Fail& fail)
      : order_(ascending_order(numbers)) {
    std::vector<std::int64_t> ascending(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      ascending[i] = numbers[order_[i]];
      if (i > 0 && ascending[i] == ascending[i - 1]) fail(order_[i]);
    }
    tags_ = GmshTags(std::move(ascending));
  }

  /// The place of a number; kNone: nothing has it.
  std::uint32_t find(std::int64_t number) const {
    const std::uint32_t found = tags_.find(number);
    return found == kNone ? found : order_[found];
  }

  /// Places in the order of their numbers.
  const std::vector<std::uint32_t>& ascending() const { return order_; }
  /// Where in that order those with these numbers begin and end.
  std::pair<std::size_t, std::size_t> range(std::int64_t first, std::int64_t last) const {
    const auto& all = tags_.all();
    const auto begin = std::lower_bound(all.begin(), all.end(), first);
    const auto end = std::upper_bound(begin, all.end(), last);
    return {static_cast<std::size_t>(begin - all.begin()),
            static_cast<std::size_t>(end - all.begin())};
  }

 private:
  std::vector<std::uint32_t> order_;
  GmshTags tags_;
};

}  // namespace tetmend::formats
