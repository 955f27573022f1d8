// SPDX-License-Identifier: MIT
// Counts of a value over all tets, and the range that a brush selects on the picture of it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tetmend::viewer {

/// Closed range of values.
struct Range {
  double low = 0;
  double high = 1;
  bool contains(double value) const { return value >= low && value <= high; }
  friend bool operator==(const Range&, const Range&) = default;
};

/// Evenly spaced bins over a range. What lies outside counts in the bin at that end, so that
/// inverted tets are not lost.
class Histogram {
 public:
  static constexpr std::size_t kBins = 80;

  Histogram() = default;
  /// Values that are not a number (deleted slots) are left out. Cost: linear.
  Histogram(std::span<const float> values, Range range);

  /// One value more, or one that was counted less.
  void add(float value) { count(value, 1); }
  void remove(float value) { count(value, static_cast<std::size_t>(-1)); }

  const Range& range() const { return range_; }
  std::span<const std::size_t> counts() const { return counts_; }
  std::size_t largest() const;  ///< count of the fullest bin
  std::size_t total() const;
  Range bin(std::size_t i) const;
  /// Height of a bar from 0 to 1. Logarithmic: a single bad tet must be seen beside a million.
  double bar(std::size_t i) const;

  /// Values between two places on the picture, 0 at its left and 1 at its right end, in any order.
  /// An end of the picture stands for all that lies beyond.
  Range brushed(double from, double to) const;

 private:
  void count(float value, std::size_t by);

  Range range_;
  std::vector<std::size_t> counts_ = std::vector<std::size_t>(kBins);
};

}  // namespace tetmend::viewer
