// SPDX-License-Identifier: MIT
// Qualities of several tets at once, and certificates that they are positive.
#pragma once

#include <cstddef>
#include <vector>

#include <tetmend/api.h>

#include "kernel/quality.h"
#include "kernel/wide.h"

namespace tetmend {

/// Says what Standard::quality() and certified_positive() say, to the last bit, in less time.
/// Allocates only when it outgrows its largest size so far.
class TETMEND_API TetBatch {
 public:
  void clear() { size_ = 0; }
  /// Until so many tets are there, add() takes no memory.
  void reserve(std::size_t tets) {
    const std::size_t groups = (tets + kWideLanes - 1) / kWideLanes;
    if (groups > groups_.size()) groups_.resize(groups);
  }
  void add(const Point& a, const Point& b, const Point& c, const Point& d);
  /// To be called when all tets are added, before the answers are read.
  void evaluate(const Standard& standard);

  Quality quality(std::size_t i) const { return static_cast<Quality>(value(kQuality, i)); }
  bool is_certified_positive(std::size_t i) const { return value(kMargin, i) > 0; }

  // Rows of a group of four tets. A lane that is not in use repeats another.
  enum Row { ax, ay, az, bx, by, bz, cx, cy, cz, dx, dy, dz, kQuality, kMargin, kRows };
  using Group = WideRows<kRows>;

 private:
  void evaluate_one_by_one(const Standard& standard);
  double value(Row row, std::size_t i) const {
    return groups_[i / kWideLanes].of[row][i % kWideLanes];
  }

  std::size_t size_ = 0;
  std::vector<Group> groups_;
};

}  // namespace tetmend
