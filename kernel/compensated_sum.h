// SPDX-License-Identifier: MIT
// Sums whose relative error stays near one rounding however many terms they have.
#pragma once

#include "kernel/wide.h"

namespace tetmend {

/// The exact error of every addition is carried along (Knuth's TwoSum).
class CompensatedSum {
 public:
  void add(double x) {
    const double sum = sum_ + x;
    const double added = sum - sum_;
    error_ += (sum_ - (sum - added)) + (x - added);
    sum_ = sum;
  }
  void add(const CompensatedSum& other) {
    add(other.sum_);
    error_ += other.error_;
  }
  double value() const { return sum_ + error_; }

 private:
  friend struct WideSum;
  double sum_ = 0;
  double error_ = 0;
};

/// A CompensatedSum in each lane.
struct WideSum {
  WideVector sum = {};
  WideVector error = {};

  /// The lanes, one after the other.
  CompensatedSum total() const {
    CompensatedSum all;
    for (std::size_t i = 0; i < kWideLanes; ++i) {
      CompensatedSum lane;
      lane.sum_ = sum[i];
      lane.error_ = error[i];
      all.add(lane);
    }
    return all;
  }
};

TETMEND_WIDE_INLINE void add_to(WideSum& to, const WideVector& x) {
  const WideVector sum = to.sum + x;
  const WideVector added = sum - to.sum;
  to.error += (to.sum - (sum - added)) + (x - added);
  to.sum = sum;
}

}  // namespace tetmend
