// SPDX-License-Identifier: MIT
// The values of one measure before and after, as an inline SVG that needs no script.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tetmend::report {

struct HistogramContent {
  enum class Better { nowhere, left, right };

  std::string name;  ///< as in JSON
  std::string title;
  std::string help;                        ///< a line below the title
  std::string unit;                        ///< what is counted: "tets"
  std::vector<double> edges;               ///< of the bins, ascending, one more than counts
  std::vector<std::size_t> before, after;  ///< of equal length
  bool is_open = true;                     ///< the bins at the ends also have what is beyond them
  Better better = Better::nowhere;         ///< where good values are
  /// Values below the first and above the second are bad; equal: none are.
  double bad_below = 0, bad_above = 0;
};

/// A <figure> with two scales, logarithmic and even, of which the style sheet shows one. Each bin
/// has a <title> with its range and its counts. Bins at the ends that are empty are left out.
std::string histogram_chart(const HistogramContent& content);

}  // namespace tetmend::report
