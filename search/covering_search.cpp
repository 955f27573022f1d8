// SPDX-License-Identifier: MIT
// Optimal covering mesh: pockets by growing length, then the core as an optimal cycle.
//
//   pocket(i, d) = best over k of pocket(i, k) + pocket(i+k, d-k) + triangle(i, i+k, i+d)
//                                                                       [chen, Eq. 1, Alg. 2]
//   full reduction = pocket(0, m-1)
//   core = shortest path around the ring: an arc i -> i+d costs pocket(i, d) + core side (i, i+d),
//          an arc of length 1 the old tet
#include "search/covering_search.h"

#include <cmath>

#include "kernel/quality_of_points.h"

namespace tetmend {

namespace {

double min3(double x, double y, double z) {
  return std::min(std::min(x, y), z);
}

}  // namespace

template <unsigned Worst>
bool BasicCoveringSearch<Worst>::Values::better_than(const Values& other) const {
  for (unsigned i = 0; i < Worst; ++i) {
    if (v[i] != other.v[i]) return v[i] > other.v[i];
  }
  return false;
}

template <unsigned Worst>
void BasicCoveringSearch<Worst>::Values::add(Quality q) {
  for (unsigned i = 0; i < Worst; ++i) {
    if (q < v[i]) std::swap(q, v[i]);
  }
}

template <unsigned Worst>
void BasicCoveringSearch<Worst>::Values::add(const Values& other) {
  for (unsigned i = 0; i < Worst; ++i) {
    if (other.v[i] == std::numeric_limits<Quality>::infinity()) return;
    add(other.v[i]);
  }
}

/// Ties go to the smaller degree.
template <unsigned Worst>
bool BasicCoveringSearch<Worst>::is_better(const Values& values, unsigned degree,
                                           const Values& other, unsigned other_degree) {
  return values.better_than(other) || (!other.better_than(values) && degree < other_degree);
}

template <unsigned Worst>
void BasicCoveringSearch<Worst>::begin(const CoveringProblem& problem) {
  size_ = static_cast<unsigned>(problem.ring.size());
  standard_ = problem.standard;
  by_points_ = !standard_.is_even() || standard_.is_own();
  weight_ = standard_.is_own() ? std::numeric_limits<double>::infinity()
                               : std::max(standard_.acute2(), standard_.obtuse2());
  floor_ = problem.floor;
  evaluations_ = 0;
  a_ = problem.a;
  b_ = problem.b;
  for (unsigned i = 0; i < size_; ++i) {
    p_[i] = problem.ring[i];
    from_a_[i] = p_[i] - a_;
    from_b_[i] = p_[i] - b_;
    a2_[i] = from_a_[i].squaredNorm();
    b2_[i] = from_b_[i].squaredNorm();
  }
  if (++run_ != 0) return;
  run_ = 1;  // the numbers are used up
  triangles_.fill({});
  for (auto& row : pairs_) row.fill({});
}

/// Quality from squared quantities; 0 if not above the floor. `smallest`, `product` and `sum` as in
/// Standard::quality().
template <unsigned Worst>
Quality BasicCoveringSearch<Worst>::above_floor(double v6, double smallest, double product,
                                                double sum) const {
  if (!(v6 > 0)) return 0;
  const double r = floor_ > 0 ? floor_ : 0;
  const double v2 = v6 * v6;
  if (!(v2 * standard_.acute2() * smallest > r * r * product)) return 0;
  const double cube = sum * sum * sum;
  const double by_length = (standard_.flat2() * cube + standard_.length() * v2) / (v2 * cube);
  const auto q = static_cast<Quality>(
      v6 * std::sqrt(std::min(standard_.acute2() * (smallest / product), by_length)));
  return q > floor_ ? q : 0;
}

/// Likewise where acute and obtuse angles differ in weight, and for a measure of a program.
template <unsigned Worst>
Quality BasicCoveringSearch<Worst>::uneven_above_floor(const Point& a, const Point& b,
                                                       const Point& c, const Point& d) const {
  const auto q = static_cast<Quality>(quality_of_points(standard_, a, b, c, d));
  return q > std::max(floor_, Quality{0}) ? q : 0;
}

template <unsigned Worst>
auto BasicCoveringSearch<Worst>::pair(unsigned low, unsigned high) -> const Pair& {
  Pair& pair = pairs_[low][high];
  if (pair.run != run_) {
    pair = {(p_[high] - p_[low]).squaredNorm(), from_a_[low].cross(from_a_[high]).squaredNorm(),
            from_b_[low].cross(from_b_[high]).squaredNorm(), run_};
  }
  return pair;
}

/// Qualities of the two tets over a triangle; indices in any rotation of the ring order.
template <unsigned Worst>
auto BasicCoveringSearch<Worst>::triangle(unsigned i, unsigned k, unsigned j) -> const Triangle& {
  if (k < i && k < j) {
    const unsigned first = k;
    k = j;
    j = i;
    i = first;
  } else if (j < i && j < k) {
    const unsigned first = j;
    j = k;
    k = i;
    i = first;
  }
  // Combinatorial number of i < k < j.
  Triangle& t = triangles_[j * (j - 1) * (j - 2) / 6 + k * (k - 1) / 2 + i];
  if (t.run != run_) evaluate(t, i, k, j);
  return t;
}

template <unsigned Worst>
void BasicCoveringSearch<Worst>::evaluate(Triangle& t, unsigned i, unsigned k, unsigned j) {
  ++evaluations_;
  t.run = run_;
  t.valid = false;
  const Point normal = (p_[k] - p_[i]).cross(p_[j] - p_[i]);
  const double upper_v6 = normal.dot(from_a_[i]);
  const double lower_v6 = -normal.dot(from_b_[i]);
  if (!(upper_v6 > 0) || !(lower_v6 > 0)) return;
  const double nn = normal.squaredNorm();
  // The angles at one side of the triangle refuse most triangles, and cost little.
  constexpr double kRounding = 1e-12;
  const double r = std::max(floor_, Quality{0});
  const double least = r * r * nn * (1 - kRounding) / weight_;
  const auto is_sharp = [&](const Pair& side) {
    return upper_v6 * upper_v6 * side.length2 < least * side.normal_a ||
           lower_v6 * lower_v6 * side.length2 < least * side.normal_b;
  };
  const Pair& ik = pair(i, k);
  if (is_sharp(ik)) return;
  const Pair& kj = pair(k, j);
  if (is_sharp(kj)) return;
  const Pair& ij = pair(i, j);
  if (is_sharp(ij)) return;
  if (by_points_) {
    t.upper = uneven_above_floor(a_, p_[i], p_[k], p_[j]);
    if (t.upper <= 0) return;
    t.lower = uneven_above_floor(b_, p_[i], p_[j], p_[k]);
    t.valid = t.lower > 0;
    return;
  }
  const double sides = ik.length2 + kj.length2 + ij.length2;
  const auto quality = [&](double v6, const auto& x2, double nik, double nkj, double nij) {
    const double smallest =
        std::min(nn * min3(x2[i] * nkj, x2[k] * nij, x2[j] * nik),
                 min3(ik.length2 * nkj * nij, kj.length2 * nij * nik, ij.length2 * nkj * nik));
    return above_floor(v6, smallest, nn * nkj * (nij * nik), sides + (x2[i] + x2[k] + x2[j]));
  };
  t.upper = quality(upper_v6, a2_, ik.normal_a, kj.normal_a, ij.normal_a);
  if (t.upper <= 0) return;
  t.lower = quality(lower_v6, b2_, ik.normal_b, kj.normal_b, ij.normal_b);
  t.valid = t.lower > 0;
}

/// Quality of the core tet (a, b, p_i, p_j); 0 if not above the floor. Precondition: ab2_ and
/// normal_ab_ are set.
template <unsigned Worst>
Quality BasicCoveringSearch<Worst>::side(unsigned i, unsigned j) {
  ++evaluations_;
  const double v6 = volume6(a_, b_, p_[i], p_[j]);
  if (!(v6 > 0)) return 0;
  if (by_points_) return uneven_above_floor(a_, b_, p_[i], p_[j]);
  const Pair& chord = pair(std::min(i, j), std::max(i, j));
  const double na = chord.normal_a;
  const double nb = chord.normal_b;
  const double smallest =
      min3(std::min(ab2_ * nb * na, chord.length2 * normal_ab_[i] * normal_ab_[j]),
           nb * std::min(a2_[i] * normal_ab_[j], a2_[j] * normal_ab_[i]),
           na * std::min(b2_[i] * normal_ab_[j], b2_[j] * normal_ab_[i]));
  return above_floor(v6, smallest, na * nb * (normal_ab_[i] * normal_ab_[j]),
                     ab2_ + chord.length2 + (a2_[i] + a2_[j]) + (b2_[i] + b2_[j]));
}

template <unsigned Worst>
void BasicCoveringSearch<Worst>::fill_pocket(const CoveringProblem& problem, unsigned i,
                                             unsigned d) {
  Pocket& pocket = pockets_[i][d];
  pocket.valid = false;
  const unsigned j = wrap(i + d);
  // A chord, unless the pocket is the whole polygon and j-i its last ring edge.
  const bool locked = d + 1 < size_
                          ? (((problem.locked_vertices >> i) | (problem.locked_vertices >> j)) & 1u)
                          : ((problem.locked_edges >> j) & 1u);
  if (locked) return;
  for (unsigned k = 1; k < d; ++k) {
    const unsigned apex = wrap(i + k);
    const Pocket& left = pockets_[i][k];
    const Pocket& right = pockets_[apex][d - k];
    if (!left.valid || !right.valid) continue;
    const Triangle& t = triangle(i, apex, j);
    if (!t.valid) continue;
    Values values = left.values;
    values.add(right.values);
    values.add(t.upper);
    values.add(t.lower);
    if (pocket.valid && !values.better_than(pocket.values)) continue;
    pocket = {values, static_cast<std::uint8_t>(apex), true};
  }
}

/// False if no ear of a real shell is possible: then no pocket is, and most searches end here.
template <unsigned Worst>
bool BasicCoveringSearch<Worst>::fill_pockets(const CoveringProblem& problem) {
  const bool is_virtual = problem.old_sides.empty();
  for (unsigned i = 0; i < size_; ++i) {
    pockets_[i][1] = {Values::best(), 0, ((problem.locked_edges >> i) & 1u) == 0};
  }
  for (unsigned d = 2; d + 1 < size_; ++d) {
    bool any = false;
    for (unsigned i = 0; i < size_; ++i) {
      fill_pocket(problem, i, d);
      any = any || pockets_[i][d].valid;
    }
    if (d == 2 && !any && !is_virtual) return false;
  }
  fill_pocket(problem, 0, size_ - 1);
  return true;
}

/// Lists the qualities of the possible sides of a core, each with the pocket behind it; returns the
/// number of ring edges that the longest spans.
template <unsigned Worst>
unsigned BasicCoveringSearch<Worst>::list_arcs(const CoveringProblem& problem, Arcs& arcs) {
  const bool is_virtual = problem.old_sides.empty();
  ab2_ = (b_ - a_).squaredNorm();
  for (unsigned i = 0; i < size_; ++i) normal_ab_[i] = from_a_[i].cross(from_b_[i]).squaredNorm();
  unsigned longest = is_virtual ? 1 : 0;
  for (unsigned i = 0; i < size_; ++i) {
    arcs[i][1] = is_virtual ? side(i, wrap(i + 1)) : problem.old_sides[i];
    for (unsigned d = 2; d + 1 < size_; ++d) {
      arcs[i][d] = pockets_[i][d].valid ? side(i, wrap(i + d)) : 0;
      if (arcs[i][d] > 0) longest = std::max(longest, d);
    }
  }
  return longest;
}

/// Fills in the best way from `start` to each vertex of the ring, and around it back to `start`.
template <unsigned Worst>
void BasicCoveringSearch<Worst>::find_ways(const Arcs& arcs, bool is_virtual, unsigned start,
                                           Ways& ways) const {
  ways[0] = {Values::best(), 0, 0, true, is_virtual};
  for (unsigned t = 1; t <= size_; ++t) {
    Way& way = ways[t];
    way.valid = false;
    for (unsigned d = 1; d <= std::min(t, size_ - 2); ++d) {
      const Way& from = ways[t - d];
      const unsigned i = wrap(start + t - d);
      // An old side may be as bad as it is; a new one was measured against the floor.
      const bool is_old = d == 1 && !is_virtual;
      if (!from.valid || !(is_old || arcs[i][d] > 0)) continue;
      Values values = from.values;
      if (d > 1) values.add(pockets_[i][d].values);
      values.add(arcs[i][d]);
      const auto sides = static_cast<std::uint8_t>(from.sides + 1);
      if (way.valid && !is_better(values, sides, way.values, way.sides)) continue;
      way = {values, static_cast<std::uint8_t>(t - d), sides, true, from.changed || d > 1};
    }
  }
}

template <unsigned Worst>
void BasicCoveringSearch<Worst>::take_core(const Ways& ways, unsigned start,
                                           Covering& covering) const {
  unsigned n = covering.degree = ways[size_].sides;
  covering.triangle_count = 0;
  for (unsigned t = size_; t > 0; t = ways[t].previous) {
    const unsigned i = wrap(start + ways[t].previous);
    covering.core[--n] = static_cast<std::uint8_t>(i);
    add_triangles(i, t - ways[t].previous, covering);
  }
}

/// The best core with at least one pocket. Any cycle meets a window of as many consecutive vertices
/// as its longest arc spans.
template <unsigned Worst>
bool BasicCoveringSearch<Worst>::find_core(const CoveringProblem& problem, Values& best,
                                           Covering& covering) {
  Arcs arcs;
  const unsigned longest = list_arcs(problem, arcs);
  bool found = false;
  for (unsigned start = 0; start < longest; ++start) {
    Ways ways;
    find_ways(arcs, problem.old_sides.empty(), start, ways);
    const Way& cycle = ways[size_];
    if (!cycle.valid || !cycle.changed || cycle.sides < 3) continue;
    if (found && !is_better(cycle.values, cycle.sides, best, covering.degree)) continue;
    found = true;
    best = cycle.values;
    take_core(ways, start, covering);
  }
  return found;
}

template <unsigned Worst>
void BasicCoveringSearch<Worst>::add_triangles(unsigned i, unsigned d, Covering& covering) const {
  if (d < 2) return;
  const unsigned apex = pockets_[i][d].apex;
  const unsigned k = apex >= i ? apex - i : apex + size_ - i;
  covering.triangles[covering.triangle_count++] = {static_cast<std::uint8_t>(i),
                                                   static_cast<std::uint8_t>(apex),
                                                   static_cast<std::uint8_t>(wrap(i + d))};
  add_triangles(i, k, covering);
  add_triangles(apex, d - k, covering);
}

template <unsigned Worst>
bool BasicCoveringSearch<Worst>::run(const CoveringProblem& problem, Covering& best) {
  begin(problem);
  const bool is_virtual = problem.old_sides.empty();
  if (!fill_pockets(problem)) return false;
  const Pocket& full = pockets_[0][size_ - 1];
  const bool full_found = full.valid;
  Values values = Values::best();
  const bool core_possible = problem.allow_core && (is_virtual || size_ > 3);
  const bool core_found = core_possible && find_core(problem, values, best);
  if (core_found && (!full_found || values.better_than(full.values))) return true;
  if (!full_found) return false;
  best.degree = 0;
  best.triangle_count = 0;
  add_triangles(0, size_ - 1, best);
  return true;
}

template <unsigned Worst>
void BasicCoveringSearch<Worst>::explore(const CoveringProblem& problem) {
  begin(problem);
  if (fill_pockets(problem)) return;
  for (unsigned d = 3; d < size_; ++d) {  // not looked at: without ears there are none
    for (unsigned i = 0; i < size_; ++i) pockets_[i][d].valid = false;
  }
}

template <unsigned Worst>
auto BasicCoveringSearch<Worst>::pocket(unsigned i, unsigned d) const -> std::optional<Ranking> {
  const Pocket& pocket = pockets_[i][d];
  return pocket.valid ? std::optional(pocket.values.v) : std::nullopt;
}

template class BasicCoveringSearch<1>;
template class BasicCoveringSearch<3>;
template class BasicCoveringSearch<2 * kMaxSearchRing>;

}  // namespace tetmend
