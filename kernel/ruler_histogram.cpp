// SPDX-License-Identifier: MIT
// The bins of rulers. The counting is in rulers.cpp, where the values are.
#include "kernel/ruler_histogram.h"

#include <algorithm>
#include <cmath>

namespace tetmend {

namespace {

constexpr int kBinsPerDoubling = 4;

double width_for(Ruler ruler) {
  switch (ruler) {
    case Ruler::non_orthogonality:
      return 2.5;  // degrees
    case Ruler::skewness:
      return 4.0 / RulerBins::kCount;  // where OpenFOAM complains
    case Ruler::condition:
    case Ruler::aspect_ratio:
    case Ruler::edge_ratio:
    case Ruler::least_altitude:
    case Ruler::step:
      return 0;
    default:
      return 1.0 / RulerBins::kCount;
  }
}

}  // namespace

RulerBins::RulerBins(Ruler ruler, double mean) : width_(width_for(ruler)) {
  if (!is_length(ruler)) return;
  constexpr int kDoublingsBelow = 7;
  exponent_ = mean > 0 && std::isfinite(mean) ? std::ilogb(mean) - kDoublingsBelow : 0;
}

std::vector<double> RulerBins::edges() const {
  std::vector<double> edges;
  for (int i = 0; i <= static_cast<int>(kCount); ++i) {
    const double quarters = kBinsPerDoubling + i % kBinsPerDoubling;
    edges.push_back(
        width_ > 0 ? width_ * i
                   : std::ldexp(quarters / kBinsPerDoubling, exponent_ + i / kBinsPerDoubling));
  }
  return edges;
}

std::size_t RulerBins::find(double value) const {
  constexpr std::size_t kLast = kCount - 1;
  if (width_ > 0) {
    const double bin = value / width_;
    return bin >= kLast ? kLast : bin > 0 ? static_cast<std::size_t>(bin) : 0;
  }
  if (!(value >= std::ldexp(1.0, exponent_))) return 0;
  if (!std::isfinite(value)) return kLast;
  const int exponent = std::ilogb(value);
  const double quarter = (std::ldexp(value, -exponent) - 1) * kBinsPerDoubling;
  const auto bin = static_cast<std::size_t>((exponent - exponent_) * kBinsPerDoubling) +
                   static_cast<std::size_t>(quarter);
  return std::min(bin, kLast);
}

}  // namespace tetmend
