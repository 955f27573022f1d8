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

/// Two zero bits after each of the 21 bits.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001F00000000FFFFull;
  x = (x | x << 16) & 0x001F0000FF0000FFull;
  x = (x | x << 8) & 0x100F00F00F00F00Full;
  x = (x | x << 4) & 0x10C30C30C30C30C3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

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
  // Without branches: which way they go is as good as random.
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    const std::uint32_t lower = q - 1;
    for (std::uint32_t& axis : x) {
      const std::uint32_t turn = (axis & q) != 0 ? lower : 0;
      const std::uint32_t exchange = (x[0] ^ axis) & lower & ~turn;
      x[0] ^= turn | exchange;
      axis ^= exchange;
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) t ^= (x[2] & q) != 0 ? q - 1 : 0;
  return spread(x[0] ^ t) << 2 | spread(x[1] ^ t) << 1 | spread(x[2] ^ t);
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
