// SPDX-License-Identifier: MIT
// Hilbert keys by the Gray-code walk: axes are turned and reflected bit by bit, then interleaved.
#include "kernel/hilbert.h"

#include <algorithm>
#include <array>

namespace tetmend {

namespace {

constexpr int kBits = 21;

}  // namespace

HilbertCurve::HilbertCurve(std::span<const Point> points) {
  if (points.empty()) return;
  Point low = points[0];
  Point high = points[0];
  for (const Point& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  origin_ = low;
  const double side = (high - low).maxCoeff();
  scale_ = side > 0 ? ((1 << kBits) - 1) / side : 0;
}

std::uint64_t HilbertCurve::key(const Point& p) const {
  std::array<std::uint32_t, 3> x{};
  for (int i = 0; i < 3; ++i) {
    const double cell = std::clamp((p[i] - origin_[i]) * scale_, 0.0, double((1 << kBits) - 1));
    x[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(cell);
  }
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    const std::uint32_t lower = q - 1;
    for (std::uint32_t& axis : x) {
      if (axis & q) {
        x[0] ^= lower;
      } else {
        const std::uint32_t t = (x[0] ^ axis) & lower;
        x[0] ^= t;
        axis ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    if (x[2] & q) t ^= q - 1;
  }
  std::uint64_t key = 0;
  for (int bit = kBits - 1; bit >= 0; --bit) {
    for (const std::uint32_t axis : x) key = key << 1 | (((axis ^ t) >> bit) & 1u);
  }
  return key;
}

}  // namespace tetmend
