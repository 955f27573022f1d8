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

void KeyHistogram::count(std::uint64_t key) {
  const std::uint64_t fine = key >> kShift;
  if (refined_.empty()) {
    ++counts_[fine / kFine];
    return;
  }
  const std::uint32_t at = refined_[fine / kFine];
  if (at != kNone) ++counts_[at * kFine + fine % kFine];
}

/// A part begins at the first fine cell that has its share of all keys before it.
void KeyHistogram::refine(std::size_t parts) {
  const auto factor = static_cast<std::int64_t>(parts);
  std::int64_t total = 0;
  for (const std::int64_t count : counts_) total += count;
  refined_.assign(counts_.size(), kNone);
  std::uint32_t chosen = 0;
  std::uint32_t cell = 0;
  std::int64_t before = 0;
  for (std::int64_t part = 1; part < factor; ++part) {
    while (total > 0 && (before + counts_[cell]) * factor < total * part) before += counts_[cell++];
    cuts_.push_back({cell, total * part - before * factor});
    if (refined_[cell] == kNone) refined_[cell] = chosen++;
  }
  counts_.assign(chosen * kFine, 0);
}

std::vector<std::uint64_t> KeyHistogram::cuts() const {
  const auto factor = static_cast<std::int64_t>(cuts_.size() + 1);
  std::vector<std::uint64_t> keys = {0};
  for (const Cut& cut : cuts_) {
    const std::int64_t* const counts = &counts_[refined_[cut.cell] * kFine];
    std::size_t fine = 0;
    for (std::int64_t before = 0; before * factor < cut.missing; ++fine) before += counts[fine];
    keys.push_back((cut.cell * std::uint64_t{kFine} + fine) << kShift);
  }
  return keys;
}

std::uint32_t Parting::part_of(const Point& point, const HilbertCurve& curve) const {
  const int zone = zones.find(point);
  if (zone >= 0) return static_cast<std::uint32_t>(cuts.size()) + static_cast<std::uint32_t>(zone);
  const auto after = std::upper_bound(cuts.begin() + 1, cuts.end(), curve.key(point));
  return static_cast<std::uint32_t>(after - cuts.begin() - 1);
}

std::vector<std::uint32_t> Parting::parts_of(std::span<const Point> points) const {
  const HilbertCurve curve = shifted_curve(low, side, shift);
  std::vector<std::uint32_t> parts(points.size());
  for_chunks(points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) parts[i] = part_of(points[i], curve);
  });
  return parts;
}

std::vector<std::uint32_t> Parting::parts_of(const Piece& gathered) const {
  if (sends_all) return parts_of(std::span(gathered.points));
  const HilbertCurve curve = shifted_curve(low, side, shift);
  std::vector<std::uint32_t> parts(gathered.points.size(), kNoPart);
  for_chunks(parts.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if ((gathered.marks[v] & kSent) != 0) parts[v] = part_of(gathered.points[v], curve);
    }
  });
  return parts;
}

}  // namespace tetmend::pieces
