// SPDX-License-Identifier: MIT
// From the numbers that a Gmsh file gives to nodes or elements to ours.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace tetmend::formats {

/// Numbers of a file may have gaps. Ours count from 0 in their order.
class GmshTags {
 public:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  GmshTags() = default;
  /// `tags` ascend and are not negative.
  explicit GmshTags(std::vector<std::int64_t> tags) : tags_(std::move(tags)) {
    if (tags_.empty()) return;
    const auto range = static_cast<std::size_t>(tags_.back() - tags_.front());
    is_dense_ = range == tags_.size() - 1;
    constexpr std::size_t kSmall = 1024;
    if (is_dense_ || range > 8 * tags_.size() + kSmall) return;
    table_.assign(range + 1, kNone);
    for (std::size_t i = tags_.size(); i-- > 0;) {
      table_[static_cast<std::size_t>(tags_[i] - tags_[0])] = static_cast<std::uint32_t>(i);
    }
  }

  /// kNone if nothing has this number.
  std::uint32_t find(std::int64_t tag) const {
    if (tags_.empty() || tag < tags_.front() || tag > tags_.back()) return kNone;
    const auto distance = static_cast<std::size_t>(tag - tags_.front());
    if (is_dense_) return static_cast<std::uint32_t>(distance);
    if (!table_.empty()) return table_[distance];
    const auto at = std::lower_bound(tags_.begin(), tags_.end(), tag);
    return *at == tag ? static_cast<std::uint32_t>(at - tags_.begin()) : kNone;
  }

  const std::vector<std::int64_t>& all() const { return tags_; }

 private:
  std::vector<std::int64_t> tags_;
  bool is_dense_ = false;
  std::vector<std::uint32_t> table_;  // by distance from the first, if there are few gaps
};

/// The order in which `tags` ascend; equal ones stay as they are.
inline std::vector<std::uint32_t> ascending_order(const std::vector<std::int64_t>& tags) {
  std::vector<std::uint32_t> order(tags.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return tags[a] < tags[b]; });
  return order;
}

/// `values`, of which `width` belong together, in another order.
template <class T>
void reorder(std::vector<T>& values, const std::vector<std::uint32_t>& order,
             std::size_t width = 1) {
  if (values.empty()) return;
  std::vector<T> sorted;
  sorted.reserve(order.size() * width);
  for (const std::uint32_t i : order) {
    for (std::size_t k = 0; k < width; ++k) sorted.push_back(values[i * width + k]);
  }
  values = std::move(sorted);
}

}  // namespace tetmend::formats
