// SPDX-License-Identifier: MIT
#include "pieces/parting.h"

#include <algorithm>
#include <cmath>

#include "kernel/chunks.h"

namespace tetmend::pieces {

HilbertCurve shifted_curve(const Point& low, double side, unsigned shift) {
  const auto fraction = [shift](double step) { return shift * step - std::floor(shift * step); };
  const Point offset(fraction(0.754877666), fraction(0.569840291), fraction(0.318309886));
  const Point origin = low - side * offset;
  const std::array<Point, 2> box = {origin, origin + Point::Constant(2 * side)};
  return HilbertCurve(box);
}

std::vector<std::uint64_t> KeyHistogram::cuts(std::size_t parts) const {
  std::int64_t total = 0;
  for (const std::int64_t count : counts_) total += count;
  std::vector<std::uint64_t> cuts(parts, 0);
  std::int64_t before = 0;
  std::size_t part = 1;
  for (std::size_t cell = 0; cell < counts_.size(); ++cell) {
    const auto is_full = [&] {
      return part < parts &&
             before * static_cast<std::int64_t>(parts) >= total * static_cast<std::int64_t>(part);
    };
    for (; is_full(); ++part) cuts[part] = std::uint64_t{cell} << kShift;
    before += counts_[cell];
  }
  for (; part < parts; ++part) cuts[part] = std::uint64_t{counts_.size()} << kShift;
  return cuts;
}

std::vector<std::uint32_t> Parting::parts_of(std::span<const Point> points) const {
  const HilbertCurve curve = shifted_curve(low, side, shift);
  std::vector<std::uint32_t> parts(points.size());
  for_chunks(points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int zone = zones.find(points[i]);
      if (zone >= 0) {
        parts[i] = static_cast<std::uint32_t>(cuts.size()) + static_cast<std::uint32_t>(zone);
        continue;
      }
      const auto after = std::upper_bound(cuts.begin() + 1, cuts.end(), curve.key(points[i]));
      parts[i] = static_cast<std::uint32_t>(after - cuts.begin() - 1);
    }
  });
  return parts;
}

}  // namespace tetmend::pieces
