// SPDX-License-Identifier: MIT
#include "viewer/mesh/histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tetmend::viewer {

Histogram::Histogram(std::span<const float> values, Range range) : range_(range) {
  for (const float value : values) add(value);
}

void Histogram::count(float value, std::size_t by) {
  if (std::isnan(value)) return;
  const double scale = static_cast<double>(kBins) / (range_.high - range_.low);
  const double at = (static_cast<double>(value) - range_.low) * scale;
  counts_[static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(kBins - 1)))] += by;
}

std::size_t Histogram::largest() const {
  return *std::max_element(counts_.begin(), counts_.end());
}

std::size_t Histogram::total() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::size_t{0});
}

Range Histogram::bin(std::size_t i) const {
  const double width = (range_.high - range_.low) / static_cast<double>(kBins);
  return {range_.low + static_cast<double>(i) * width,
          range_.low + static_cast<double>(i + 1) * width};
}

double Histogram::bar(std::size_t i) const {
  const std::size_t most = largest();
  if (most == 0) return 0;
  return std::log1p(static_cast<double>(counts_[i])) / std::log1p(static_cast<double>(most));
}

Range Histogram::brushed(double from, double to) const {
  constexpr double kEverything = std::numeric_limits<double>::max();
  const double low = std::min(from, to);
  const double high = std::max(from, to);
  const double width = range_.high - range_.low;
  return {low <= 0 ? -kEverything : range_.low + low * width,
          high >= 1 ? kEverything : range_.low + high * width};
}

}  // namespace tetmend::viewer
