// SPDX-License-Identifier: MIT
// Hilbert keys by the Gray-code walk: axes are turned and reflected bit by bit, then interleaved.
#include "kernel/hilbert.h"

#include <algorithm>
#include <array>
#include <utility>

#include <tbb/parallel_sort.h>

#include "kernel/chunks.h"

namespace tetmend {

namespace {

constexpr int kBits = 21;

}  // namespace

HilbertCurve::HilbertCurve(std::span<const Point> points) {
  if (points.empty()) return;
  using Box = std::pair<Point, Point>;
  const auto extend = [](Box& box, const Point& low, const Point& high) {
    box.first = box.first.cwiseMin(low);
    box.second = box.second.cwiseMax(high);
  };
  const auto boxes = map_chunks<Box>(points.size(), [&](std::size_t begin, std::size_t end) {
    Box box(points[begin], points[begin]);
    for (std::size_t i = begin; i < end; ++i) extend(box, points[i], points[i]);
    return box;
  });
  Box all = boxes[0];
  for (const Box& box : boxes) extend(all, box.first, box.second);
  const Point& low = all.first;
  const Point& high = all.second;
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

void sort_along_curve(std::span<const Point> points, std::vector<std::uint32_t>& numbers) {
  const HilbertCurve curve(points);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed(numbers.size());
  for_chunks(numbers.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      keyed[i] = {curve.key(points[numbers[i]]), numbers[i]};
  });
  tbb::parallel_sort(keyed.begin(), keyed.end());
  for_chunks(numbers.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) numbers[i] = keyed[i].second;
  });
}

}  // namespace tetmend
