// SPDX-License-Identifier: MIT
// In which sets an element is, while sets are gone through one by one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tetmend::formats {

/// Chains of sets: elements of one chain are in the same sets. A chain is kept as the one that it
/// went on from and its last set: n sets around one element are n chains, and take memory for n
/// numbers, not for n of n.
class SetChains {
 public:
  /// A chain without a set.
  std::uint32_t begin() {
    links_.push_back({kNone, 0});
    return static_cast<std::uint32_t>(links_.size() - 1);
  }
  /// The chain that goes on with `set`; the same for the same.
  std::uint32_t with(std::uint32_t chain, std::uint32_t set) {
    const std::uint64_t key = std::uint64_t{chain} << 32 | set;
    const auto [at, is_new] = next_.try_emplace(key, static_cast<std::uint32_t>(links_.size()));
    if (is_new) links_.push_back({chain, set});
    return at->second;
  }
  std::size_t size() const { return links_.size(); }
  /// The set that was added last. Precondition: there is one.
  std::uint32_t last(std::uint32_t chain) const { return links_[chain].set; }

  /// Looks through its sets, one by one.
  bool has(std::uint32_t chain, std::uint32_t set) const {
    for (; links_[chain].before != kNone; chain = links_[chain].before) {
      if (links_[chain].set == set) return true;
    }
    return false;
  }
  /// Its sets, in the order in which they were added.
  std::vector<std::uint32_t> sets(std::uint32_t chain) const {
    std::vector<std::uint32_t> found;
    for (; links_[chain].before != kNone; chain = links_[chain].before) {
      found.push_back(links_[chain].set);
    }
    std::reverse(found.begin(), found.end());
    return found;
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  struct Link {
    std::uint32_t before;
    std::uint32_t set;
  };
  std::vector<Link> links_;
  std::unordered_map<std::uint64_t, std::uint32_t> next_;
};

}  // namespace tetmend::formats
