// SPDX-License-Identifier: MIT
// Hilbert keys by the Gray-code walk, with a table of the ways in which axes are turned and
// reflected from level to level.
#include "kernel/hilbert.h"

#include <algorithm>
#include <array>
#include <utility>

#include <tbb/parallel_sort.h>

#include "kernel/chunks.h"

namespace tetmend {

namespace {

/// One step along the curve. The bits of the three axes at one level or two, most significant
/// first, give one digit of the key or two. They also give the way in which the axes are turned and
/// reflected below.
struct Step {
  std::uint8_t digit;
  std::uint8_t next;
};

/// How the axes are turned and reflected: axis[i] of a point stands where axis i should, with its
/// bits inverted if flip[i]; `odd` inverts the digits.
struct Turn {
  std::array<std::uint8_t, 3> axis = {0, 1, 2};
  std::array<bool, 3> flip = {};
  bool odd = false;
  friend constexpr bool operator==(const Turn&, const Turn&) = default;
};

/// The Gray-code walk of one level; `bits` holds those of axis i at bit i.
constexpr unsigned walk(Turn& turn, unsigned bits) {
  std::array<bool, 3> x{};
  for (std::size_t i = 0; i < 3; ++i) x[i] = ((bits >> turn.axis[i] & 1u) != 0) != turn.flip[i];
  for (std::size_t i = 0; i < 3; ++i) {
    if (x[i]) {
      turn.flip[0] = !turn.flip[0];
    } else {
      const Turn before = turn;
      turn.axis[0] = before.axis[i];
      turn.axis[i] = before.axis[0];
      turn.flip[0] = before.flip[i];
      turn.flip[i] = before.flip[0];
    }
  }
  const bool second = x[1] != x[0];
  const bool third = x[2] != second;
  const bool odd = turn.odd;
  turn.odd = odd != third;
  return (x[0] != odd ? 4u : 0u) | (second != odd ? 2u : 0u) | (third != odd ? 1u : 0u);
}

constexpr std::size_t kTurns = 96;
using Steps = std::array<std::array<Step, 8>, kTurns>;

/// All turns that can follow each other, from the first on, in the order in which they are met.
constexpr Steps kSteps = [] {
  std::array<Turn, kTurns> turns{};
  std::size_t known = 1;
  Steps steps{};
  for (std::size_t n = 0; n < known; ++n) {
    for (unsigned bits = 0; bits < 8; ++bits) {
      Turn turn = turns[n];
      steps[n][bits].digit = static_cast<std::uint8_t>(walk(turn, bits));
      std::size_t next = 0;
      while (next < known && !(turns[next] == turn)) ++next;
      if (next == known) turns[known++] = turn;
      steps[n][bits].next = static_cast<std::uint8_t>(next);
    }
  }
  return steps;
}();

/// Two levels in one step. The index holds two bits of each axis: those of axis i at bit 2 i.
constexpr auto kDoubleSteps = [] {
  std::array<std::array<Step, 64>, kTurns> steps{};
  for (std::size_t turn = 0; turn < kTurns; ++turn) {
    for (unsigned index = 0; index < 64; ++index) {
      unsigned high = 0;
      unsigned low = 0;
      for (unsigned i = 0; i < 3; ++i) {
        high |= (index >> (2 * i + 1) & 1u) << i;
        low |= (index >> (2 * i) & 1u) << i;
      }
      const Step first = kSteps[turn][high];
      const Step second = kSteps[first.next][low];
      steps[turn][index] = {static_cast<std::uint8_t>(first.digit << 3 | second.digit),
                            second.next};
    }
  }
  return steps;
}();

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

HilbertCurve::Cell HilbertCurve::cell(const Point& p) const {
  Cell x{};
  for (int i = 0; i < 3; ++i) {
    const double cell = std::clamp((p[i] - origin_[i]) * scale_, 0.0, double((1 << kBits) - 1));
    x[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(cell);
  }
  return x;
}

std::uint64_t HilbertCurve::key(const Cell& x) {
  static_assert(kBits % 2 == 1);
  constexpr int kTop = kBits - 1;
  Step step = kSteps[0][x[0] >> kTop | x[1] >> kTop << 1 | x[2] >> kTop << 2];
  std::uint64_t key = step.digit;
  for (int level = kTop - 2; level >= 0; level -= 2) {
    const unsigned index =
        (x[0] >> level & 3u) | (x[1] >> level & 3u) << 2 | (x[2] >> level & 3u) << 4;
    step = kDoubleSteps[step.next][index];
    key = key << 6 | step.digit;
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
