// SPDX-License-Identifier: MIT
// Items put in groups by a key: a stable counting sort.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tetmend {

/// The items of key k are order[begin[k]] to order[begin[k + 1] - 1], in ascending order.
struct Grouping {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> begin;  ///< one more than there are keys

  std::span<const std::uint32_t> group(std::uint32_t key) const {
    return {order.data() + begin[key], order.data() + begin[key + 1]};
  }
};

/// Groups the items 0 to key.size() - 1 by their keys. Precondition: each key is less than `keys`.
/// Cost: linear; 4 bytes an item besides the result.
Grouping group_by_key(std::span<const std::uint32_t> key, std::uint32_t keys);

}  // namespace tetmend
