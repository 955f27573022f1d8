// SPDX-License-Identifier: MIT
#include "pieces/parting.h"

#include <algorithm>
#include <bit>
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
  return stretch_of(curve.key(point));
}

std::uint32_t Parting::stretch_of(std::uint64_t key) const {
  const auto after = std::upper_bound(cuts.begin() + 1, cuts.end(), key);
  return static_cast<std::uint32_t>(after - cuts.begin() - 1);
}

namespace {

/// Cells from `least` to `most` along each axis.
struct CellBox {
  HilbertCurve::Cell least, most;
};

/// Calls use(first, last) for the keys of a cube of 2^level cells a side, or where that says no, of those
/// of its eighths that the box meets.
template <class Use>
void for_keys(const HilbertCurve::Cell& cube, int level, const CellBox& box, const Use& use) {
  const std::uint64_t inside = (std::uint64_t{1} << (3 * level)) - 1;
  const std::uint64_t first = HilbertCurve::key(cube) & ~inside;
  if (use(first, first | inside) || level == 0) return;
  const std::uint32_t half = 1U << (level - 1);
  for (unsigned i = 0; i < 8; ++i) {
    HilbertCurve::Cell eighth = cube;
    bool meets = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if ((i >> axis & 1U) != 0) eighth[axis] += half;
      meets = meets && eighth[axis] <= box.most[axis] && eighth[axis] + half > box.least[axis];
    }
    if (meets) for_keys(eighth, level - 1, box, use);
  }
}

}  // namespace

std::vector<std::uint32_t> Parting::stretches_of(const Eigen::AlignedBox3d& box) const {
  const HilbertCurve curve = shifted_curve(low, side, shift);
  const CellBox cells{curve.cell(box.min()), curve.cell(box.max())};
  int level = 0;  // of the smallest cube that has all of them
  HilbertCurve::Cell cube{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    level = std::max(level, static_cast<int>(std::bit_width(cells.least[axis] ^ cells.most[axis])));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) cube[axis] = cells.least[axis] >> level << level;
  std::vector<std::uint32_t> found;
  for_keys(cube, level, cells, [&](std::uint64_t first, std::uint64_t last) {
    const std::uint32_t stretch = stretch_of(first);
    if (stretch != stretch_of(last)) return false;
    found.push_back(stretch);
    return true;
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
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
