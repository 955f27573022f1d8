// SPDX-License-Identifier: MIT
#include "search/polyhedron_search.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "kernel/judge.h"
#include "kernel/quality_of_points.h"

namespace tetmend {

namespace {

/// No tet has this quality.
constexpr Quality kUnknown = -2;

PointMask bit(unsigned point) {
  return PointMask{1} << point;
}

/// Takes the lowest point out of a set.
unsigned take_lowest(PointMask& mask) {
  const auto lowest = static_cast<unsigned>(std::countr_zero(mask));
  mask &= mask - 1;
  return lowest;
}

template <std::size_t N>
std::array<unsigned, N> corners_of(PointMask mask) {
  std::array<unsigned, N> corners;
  for (unsigned& corner : corners) corner = take_lowest(mask);
  return corners;
}

/// A number for each open face, well mixed: the sum of those of a front, modulo 2, is its key.
std::uint64_t key_of(unsigned triangle, std::uint8_t taken) {
  std::uint64_t x = (4u * triangle + taken + 1u) * 0x9E3779B97F4A7C15ull;
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ x >> 27) * 0x94D049BB133111EBull;
  return x ^ x >> 31;
}

constexpr std::size_t kDeadEnds = 1024;

/// Whether three different numbers are in ascending order up to a rotation.
bool is_even(const PolyhedronProblem::Triangle& t) {
  return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
}

}  // namespace

void PolyhedronSearch::clear(const Standard& standard) {
  standard_ = standard;
  table_.clear();
  quality_.clear();
}

void PolyhedronSearch::add(const Point& point) {
  table_.add(point);
  quality_.resize(SideTable::rank(0, 1, 2, table_.size()), kUnknown);
}

bool PolyhedronSearch::run(const PolyhedronProblem& problem) {
  assert(problem.floor >= 0);
  begin(problem);
  if (open_surface()) descend(0, {std::numeric_limits<Quality>::infinity(), 0});
  return !best_.empty();
}

void PolyhedronSearch::begin(const PolyhedronProblem& problem) {
  problem_ = problem;
  admission_.assign(quality_.size(), Admission::unknown);
  taken_.assign(SideTable::rank(0, 1, table_.size()), 0);
  surface_corners_.clear();
  surface_triangles_.clear();
  fronts_.clear();
  placed_.clear();
  best_.clear();
  dead_ends_.assign(kDeadEnds, {});
  front_key_ = 0;
  forgets_ = false;
  floor_ = problem.floor;
  nodes_ = 0;
  cut_short_ = done_ = false;
}

/// The first front. False if a face has no apex.
bool PolyhedronSearch::open_surface() {
  for (const auto& t : problem_.surface) {
    const PointMask corners = bit(t[0]) | bit(t[1]) | bit(t[2]);
    const auto [a, b, c] = corners_of<3>(corners);
    const unsigned triangle = SideTable::rank(a, b, c);
    // An inner point d has volume6(d, t0, t1, t2) > 0, that is volume6(t0, t1, t2, d) < 0.
    taken_[triangle] = is_even(t) ? kAbove : kBelow;
    front_key_ ^= key_of(triangle, taken_[triangle]);
    surface_corners_.push_back(corners);
    surface_triangles_.push_back(triangle);
  }
  for (std::size_t i = 0; i < surface_triangles_.size(); ++i) {
    if (!open_face(surface_triangles_[i], surface_corners_[i])) return false;
  }
  return true;
}

/// Fills the front from `front` to the end in all ways that are better than the best so far.
void PolyhedronSearch::descend(std::size_t front, Path path) {
  const std::size_t front_end = fronts_.size();
  const Quality floor = floor_;  // for which the front was made
  if (front == front_end) return finish(path);
  if (dead_end().front == front_key_ && dead_end().deficit <= path.deficit) return;
  const auto fewest = std::min_element(fronts_.begin() + static_cast<std::ptrdiff_t>(front),
                                       fronts_.end(), [](const OpenFace& x, const OpenFace& y) {
                                         return std::popcount(x.apexes) < std::popcount(y.apexes);
                                       });
  const OpenFace face = *fewest;

  struct Choice {
    Quality quality;
    unsigned apex;
  };
  std::array<Choice, SideTable::kMaxPoints> choices;
  std::size_t count = 0;
  for (PointMask left = face.apexes; left != 0;) {
    const unsigned apex = take_lowest(left);
    choices[count++] = {quality(face.corners | bit(apex)), apex};
  }
  const auto end = choices.begin() + static_cast<std::ptrdiff_t>(count);
  std::sort(choices.begin(), end, [](const Choice& x, const Choice& y) {
    return x.quality != y.quality ? x.quality > y.quality : x.apex < y.apex;
  });

  for (auto choice = choices.begin(); choice != end; ++choice) {
    const Path next = {std::min(path.worst, choice->quality),
                       path.deficit + deficit(choice->quality)};
    if (!(path.worst > floor_)) return;
    // Those that follow are no better.
    if (!(next.worst > floor_) || !(next.deficit <= problem_.deficit_limit)) break;
    if (nodes_ == problem_.max_nodes) cut_short_ = done_ = true;
    if (done_) return;
    ++nodes_;
    if (place(front, face, choice->apex, floor)) descend(front_end, next);
    take_back(front_end);
    if (done_) return;
  }
  if (path.worst > floor_ && !forgets_) dead_end() = {front_key_, path.deficit};
}

/// Nothing is open any more.
void PolyhedronSearch::finish(Path path) {
  PointMask used = 0;
  for (const PlacedTet& tet : placed_) used |= tet.corners;
  if ((problem_.kept & ~used) != 0) {
    forgets_ = true;
    return;
  }
  best_.clear();
  for (const PlacedTet& tet : placed_) best_.push_back(in_positive_order(tet));
  floor_ = path.worst;
  done_ = floor_ >= problem_.enough;
}

/// Places a tet and appends the front behind it. False if some face has no apex left; what was done
/// is taken back by the caller.
bool PolyhedronSearch::place(std::size_t front, const OpenFace& face, unsigned apex,
                             Quality floor) {
  const PlacedTet placed = describe(face.corners | bit(apex));
  placed_.push_back(placed);
  bool fits = true;
  for (unsigned i = 0; i < 4; ++i)
    fits = fits && (taken_[placed.triangles[i]] & placed.sides[i]) == 0;
  // Flipped, so that take_back() need not know whether the tet did fit.
  flip_sides(placed);
  return fits && advance_front(front, placed, floor);
}

void PolyhedronSearch::take_back(std::size_t front_end) {
  flip_sides(placed_.back());
  placed_.pop_back();
  fronts_.resize(front_end);
}

/// Marks the sides of a tet as taken, or the other way round.
void PolyhedronSearch::flip_sides(const PlacedTet& placed) {
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned triangle = placed.triangles[i];
    std::uint8_t& taken = taken_[triangle];
    if (taken == kAbove || taken == kBelow) front_key_ ^= key_of(triangle, taken);
    taken ^= placed.sides[i];
    if (taken == kAbove || taken == kBelow) front_key_ ^= key_of(triangle, taken);
  }
}

bool PolyhedronSearch::advance_front(std::size_t front, const PlacedTet& placed, Quality floor) {
  const std::size_t front_end = fronts_.size();
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned triangle = placed.triangles[i];
    if (taken_[triangle] == kBoth) continue;
    const PointMask opposite = bit(corners_of<4>(placed.corners)[i]);
    if (!open_face(triangle, placed.corners & ~opposite)) return false;
  }
  for (std::size_t i = front; i < front_end; ++i) {
    OpenFace face = fronts_[i];
    if (taken_[face.triangle] == kBoth) continue;
    face.apexes &= ~blocked_apexes(face, placed);
    if (floor < floor_) face.apexes &= better_apexes(face);
    if (face.apexes == 0) return false;
    fronts_.push_back(face);
  }
  return true;
}

/// Appends a face to the front that is made. False if it has no apex.
bool PolyhedronSearch::open_face(unsigned triangle, PointMask corners) {
  OpenFace face = {triangle, corners, 0};
  for (PointMask left = empty_side(triangle); left != 0;) {
    const unsigned apex = take_lowest(left);
    const PointMask tet = corners | bit(apex);
    if (is_better(tet) && is_admitted(tet) && !overlaps_placed(tet)) face.apexes |= bit(apex);
  }
  fronts_.push_back(face);
  return face.apexes != 0;
}

/// Points on the side of an open face that has no tet.
PointMask PolyhedronSearch::empty_side(unsigned triangle) const {
  const SideTable::Sides& sides = table_.sides(triangle);
  return (taken_[triangle] & kAbove) != 0 ? sides.below : sides.above;
}

/// Apexes whose tet would overlap the placed one.
PointMask PolyhedronSearch::blocked_apexes(const OpenFace& face, const PlacedTet& placed) const {
  if ((placed.corners & empty_side(face.triangle)) == 0) return 0;
  PointMask suspects = face.apexes;
  for (const PointMask beyond : placed.beyond) {
    if ((face.corners & beyond) == 0) suspects &= beyond;
  }
  PointMask blocked = 0;
  while (suspects != 0) {
    const unsigned apex = take_lowest(suspects);
    if (table_.overlap(face.corners | bit(apex), placed.corners)) blocked |= bit(apex);
  }
  return blocked;
}

/// Apexes whose tet is better than the worst of the best filling.
PointMask PolyhedronSearch::better_apexes(const OpenFace& face) {
  PointMask better = 0;
  for (PointMask left = face.apexes; left != 0;) {
    const unsigned apex = take_lowest(left);
    if (is_better(face.corners | bit(apex))) better |= bit(apex);
  }
  return better;
}

bool PolyhedronSearch::is_better(PointMask tet) {
  return quality(tet) > floor_;
}

Quality PolyhedronSearch::quality(PointMask tet) {
  const auto [a, b, c, d] = corners_of<4>(tet);
  Quality& known = quality_[SideTable::rank(a, b, c, d)];
  if (known == kUnknown) {
    known = static_cast<Quality>(std::abs(quality_of_points(
        standard_, table_.point(a), table_.point(b), table_.point(c), table_.point(d))));
  }
  return known;
}

/// Whether a tet lies inside the polyhedron and holds no point that must be kept, as far as can be
/// told.
bool PolyhedronSearch::is_admitted(PointMask tet) {
  const auto [a, b, c, d] = corners_of<4>(tet);
  Admission& known = admission_[SideTable::rank(a, b, c, d)];
  if (known == Admission::unknown) {
    const PlacedTet described = describe(tet);
    const auto& beyond = described.beyond;
    const PointMask inside = beyond[0] & beyond[1] & beyond[2] & beyond[3];
    const bool refused =
        tet == problem_.banned || (inside & problem_.kept) != 0 || crosses_surface(described);
    known = refused ? Admission::refused : Admission::admitted;
  }
  return known == Admission::admitted;
}

bool PolyhedronSearch::crosses_surface(const PlacedTet& tet) const {
  for (std::size_t i = 0; i < surface_triangles_.size(); ++i) {
    const PointMask corners = surface_corners_[i];
    const SideTable::Sides& sides = table_.sides(surface_triangles_[i]);
    if ((tet.corners & sides.above) == 0 || (tet.corners & sides.below) == 0) continue;
    if (std::any_of(tet.beyond.begin(), tet.beyond.end(),
                    [&](PointMask beyond) { return (corners & beyond) == 0; })) {
      continue;
    }
    if (table_.overlap(tet.corners, corners)) return true;
  }
  return false;
}

bool PolyhedronSearch::overlaps_placed(PointMask tet) const {
  return std::any_of(placed_.begin(), placed_.end(), [&](const PlacedTet& placed) {
    for (const PointMask beyond : placed.beyond) {
      if ((tet & beyond) == 0) return false;
    }
    return table_.overlap(tet, placed.corners);
  });
}

PolyhedronSearch::PlacedTet PolyhedronSearch::describe(PointMask tet) const {
  const auto corners = corners_of<4>(tet);
  const auto [a, b, c, d] = corners;
  PlacedTet placed;
  placed.corners = tet;
  placed.triangles = {SideTable::rank(b, c, d), SideTable::rank(a, c, d), SideTable::rank(a, b, d),
                      SideTable::rank(a, b, c)};
  for (unsigned i = 0; i < 4; ++i) {
    const SideTable::Sides& sides = table_.sides(placed.triangles[i]);
    const bool is_above = (sides.above & bit(corners[i])) != 0;
    placed.sides[i] = is_above ? kAbove : kBelow;
    placed.beyond[i] = is_above ? sides.above : sides.below;
  }
  return placed;
}

PolyhedronSearch::Tet PolyhedronSearch::in_positive_order(const PlacedTet& tet) const {
  const auto corners = corners_of<4>(tet.corners);
  Tet ordered{};
  for (unsigned i = 0; i < 4; ++i) ordered[i] = static_cast<std::uint8_t>(corners[i]);
  if (tet.sides[3] == kBelow) std::swap(ordered[2], ordered[3]);
  return ordered;
}

}  // namespace tetmend
