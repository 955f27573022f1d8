// SPDX-License-Identifier: MIT
// The covering search against an enumeration of all coverings of random rings of 3 to 8 points.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "kernel/geometry.h"
#include "kernel/quality.h"
#include "search/covering_search.h"

using namespace tetmend;

namespace {

// Vertices are numbers: 0 .. m-1 the ring, m and m+1 the ends a and b of the edge.
using Chain = std::vector<unsigned>;  // ring vertices, ascending
using Chord = std::pair<unsigned, unsigned>;
using RingTet = std::array<unsigned, 4>;  // in positive order
using RingFace = std::array<unsigned, 3>;
using RingEdge = std::array<unsigned, 2>;

struct Candidate {
  Chain core;                    // empty: full reduction
  std::vector<Chain> triangles;  // ascending
  std::vector<unsigned> tets;    // in the list of the ring
  std::vector<bool> grows;       // per ancestor: the covering has a face around it that is new
};

/// A covering is a set of chords that do not cross. All cells are triangles but for the core, which
/// is any one cell or none.
struct Ring {
  unsigned m;
  std::vector<RingTet> tets;         // of any covering
  std::vector<Candidate> coverings;  // the old mesh, whose core is the whole ring, included
  std::vector<RingEdge> ancestors;   // a p_i, then b p_i, then p_i p_i+1

  unsigned a() const { return m; }
  unsigned b() const { return m + 1; }
  unsigned next(unsigned i) const { return (i + 1) % m; }
  bool is_ring_side(unsigned i, unsigned j) const { return j == next(i); }
};

bool cross(Chord x, Chord y) {
  if (y < x) std::swap(x, y);
  return x.first < y.first && y.first < x.second && x.second < y.second;
}

/// Appends all sets of chords that extend `chosen` by chords from `n` on without crossing.
void list_dissections(const std::vector<Chord>& chords, std::size_t n, std::vector<Chord>& chosen,
                      std::vector<std::vector<Chord>>& dissections) {
  if (n == chords.size()) {
    dissections.push_back(chosen);
    return;
  }
  list_dissections(chords, n + 1, chosen, dissections);
  const auto crosses = [&](Chord other) { return cross(chords[n], other); };
  if (std::any_of(chosen.begin(), chosen.end(), crosses)) return;
  chosen.push_back(chords[n]);
  list_dissections(chords, n + 1, chosen, dissections);
  chosen.pop_back();
}

void cut_into_cells(const Chain& polygon, std::vector<Chord> chords, std::vector<Chain>& cells) {
  while (!chords.empty()) {
    const Chord chord = chords.back();
    chords.pop_back();
    const auto first = std::find(polygon.begin(), polygon.end(), chord.first);
    const auto last = std::find(polygon.begin(), polygon.end(), chord.second);
    if (first == polygon.end() || last == polygon.end()) continue;
    Chain rest(polygon.begin(), first + 1);
    rest.insert(rest.end(), last, polygon.end());
    cut_into_cells(Chain(first, last + 1), chords, cells);
    cut_into_cells(rest, chords, cells);
    return;
  }
  cells.push_back(polygon);
}

std::vector<RingTet> tets_of(const Ring& ring, const Candidate& covering) {
  std::vector<RingTet> tets;
  for (const Chain& t : covering.triangles) {
    tets.push_back({ring.a(), t[0], t[1], t[2]});
    tets.push_back({t[0], t[1], t[2], ring.b()});
  }
  const Chain& core = covering.core;
  for (std::size_t n = 0; n < core.size(); ++n) {
    tets.push_back({ring.a(), ring.b(), core[n], core[(n + 1) % core.size()]});
  }
  return tets;
}

/// How many of the tets have each face.
std::map<RingFace, unsigned> count_faces(const std::vector<RingTet>& tets) {
  std::map<RingFace, unsigned> count;
  for (RingTet tet : tets) {
    std::sort(tet.begin(), tet.end());
    ++count[{tet[1], tet[2], tet[3]}];
    ++count[{tet[0], tet[2], tet[3]}];
    ++count[{tet[0], tet[1], tet[3]}];
    ++count[{tet[0], tet[1], tet[2]}];
  }
  return count;
}

std::set<RingFace> faces_around(RingEdge edge, const std::vector<RingTet>& tets) {
  std::set<RingFace> around;
  for (const auto& entry : count_faces(tets)) {
    const RingFace& face = entry.first;
    const auto has = [&](unsigned v) {
      return std::find(face.begin(), face.end(), v) != face.end();
    };
    if (has(edge[0]) && has(edge[1])) around.insert(face);
  }
  return around;
}

/// The faces with one tet are those of the ring with a and b, all others have two.
bool faces_close(const Ring& ring, const std::vector<RingTet>& tets) {
  std::set<RingFace> outer;
  for (const auto& [face, n] : count_faces(tets)) {
    if (n > 2) return false;
    if (n == 1) outer.insert(face);
  }
  std::set<RingFace> expected;
  for (unsigned i = 0; i < ring.m; ++i) {
    for (const unsigned apex : {ring.a(), ring.b()}) {
      RingFace face = {i, ring.next(i), apex};
      std::sort(face.begin(), face.end());
      expected.insert(face);
    }
  }
  return outer == expected;
}

void add_covering(Ring& ring, std::vector<Chain> triangles, Chain core) {
  Candidate covering = {std::move(core), std::move(triangles), {}, {}};
  std::sort(covering.triangles.begin(), covering.triangles.end());
  for (const RingTet& tet : tets_of(ring, covering)) {
    const auto known = std::find(ring.tets.begin(), ring.tets.end(), tet);
    covering.tets.push_back(static_cast<unsigned>(known - ring.tets.begin()));
    if (known == ring.tets.end()) ring.tets.push_back(tet);
  }
  ring.coverings.push_back(std::move(covering));
}

Ring make_ring(unsigned m) {
  Ring ring = {m, {}, {}, {}};
  Chain polygon;
  std::vector<Chord> chords;
  for (unsigned i = 0; i < m; ++i) {
    polygon.push_back(i);
    for (unsigned j = i + 2; j < m; ++j) {
      if (!ring.is_ring_side(j, i)) chords.emplace_back(i, j);
    }
  }
  std::vector<Chord> chosen;
  std::vector<std::vector<Chord>> dissections;
  list_dissections(chords, 0, chosen, dissections);
  for (const std::vector<Chord>& dissection : dissections) {
    std::vector<Chain> cells;
    cut_into_cells(polygon, dissection, cells);
    const auto is_large = [](const Chain& cell) { return cell.size() > 3; };
    const auto large = std::count_if(cells.begin(), cells.end(), is_large);
    if (large == 0) add_covering(ring, cells, {});
    for (std::size_t n = 0; n < cells.size(); ++n) {
      if (large - (is_large(cells[n]) ? 1 : 0) > 0) continue;
      std::vector<Chain> triangles = cells;
      triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(n));
      add_covering(ring, triangles, cells[n]);
    }
  }

  for (const unsigned end : {ring.a(), ring.b()}) {
    for (unsigned i = 0; i < m; ++i) ring.ancestors.push_back({end, i});
  }
  for (unsigned i = 0; i < m; ++i) ring.ancestors.push_back({i, ring.next(i)});
  const std::vector<RingTet> old_tets = tets_of(ring, {polygon, {}, {}, {}});
  for (Candidate& covering : ring.coverings) {
    const std::vector<RingTet> tets = tets_of(ring, covering);
    for (const RingEdge& edge : ring.ancestors) {
      const std::set<RingFace> before = faces_around(edge, old_tets);
      const std::set<RingFace> after = faces_around(edge, tets);
      covering.grows.push_back(
          !std::includes(before.begin(), before.end(), after.begin(), after.end()));
    }
  }
  return ring;
}

constexpr unsigned kSmallest = 3;
constexpr unsigned kLargest = 8;

const Ring& ring_of(unsigned m) {
  static const std::vector<Ring> kRings = [] {
    std::vector<Ring> rings;
    for (unsigned n = kSmallest; n <= kLargest; ++n) rings.push_back(make_ring(n));
    return rings;
  }();
  return kRings[m - kSmallest];
}

/// The mask form of ancestors[n], see CoveringProblem.
void lock(const Ring& ring, unsigned n, CoveringProblem& problem) {
  if (n < 2 * ring.m) {
    problem.locked_vertices |= 1u << (n % ring.m);
  } else {
    problem.locked_edges |= 1u << (n - 2 * ring.m);
  }
}

class RingRandom {
 public:
  explicit RingRandom(std::uint64_t seed) : engine_(seed) {}
  double real(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }
  unsigned below(unsigned n) { return static_cast<unsigned>(engine_() % n); }

 private:
  std::mt19937_64 engine_;
};

/// Ranges of the cylinder coordinates of the ring; the angles between neighbours are in proportion
/// to weights from smallest_gap to 1. The axis ab, of length 2 at most, may be moved off the
/// origin.
struct Shape {
  const char* name;
  double smallest_gap;
  double smallest_radius;
  double largest_height;
  double largest_offset;
};

constexpr std::array<Shape, 5> kShellShapes = {{{"near-regular", 0.9, 0.9, 0.05, 0.02},
                                                {"irregular", 0.3, 0.4, 0.5, 0.1},
                                                {"non-convex", 0.3, 0.1, 0.5, 0.05},
                                                {"slivers", 1e-4, 0.3, 0.4, 0.1},
                                                {"tall", 0.2, 0.3, 1.5, 0.1}}};

constexpr std::array<Shape, 4> kSandwichShapes = {{{"near-regular", 0.9, 0.9, 0.05, 0.3},
                                                   {"irregular", 0.3, 0.4, 0.3, 0.6},
                                                   {"non-convex", 0.2, 0.1, 0.2, 1.0},
                                                   {"slivers", 1e-4, 0.3, 0.1, 0.5}}};

std::vector<Point> random_ring_points(RingRandom& random, unsigned m, const Shape& shape) {
  std::vector<double> gaps(m);
  double sum = 0;
  for (double& gap : gaps) {
    // Even in the logarithm, so that gaps of all sizes are met.
    gap = std::pow(shape.smallest_gap, random.real(0, 1));
    sum += gap;
  }
  const double half = random.real(0.2, 1);
  const double dx = shape.largest_offset * random.real(-1, 1);
  const double dy = shape.largest_offset * random.real(-1, 1);
  std::vector<Point> points;
  double angle = 0;
  for (unsigned i = 0; i < m; ++i) {
    const double radius = random.real(shape.smallest_radius, 1);
    const double height = shape.largest_height * random.real(-1, 1);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    angle += 2 * std::numbers::pi * gaps[i] / sum;
  }
  points.emplace_back(dx, dy, -half);
  points.emplace_back(dx + 0.2 * random.real(-1, 1), dy + 0.2 * random.real(-1, 1), half);

  Eigen::Quaterniond turn(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1),
                          random.real(-1, 1));
  turn.normalize();
  const Point shift(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
  for (Point& p : points) p = turn * p + shift;
  return points;
}

using QualityVector = std::vector<double>;  // qualities, ascending

/// A shell of an edge ab, or a sandwich: sandwiched triangles between a and b that form a polygon.
struct Case {
  const Ring* ring;
  const char* shape;
  std::vector<Point> points;  // the ring, a, b
  QualityVector qualities;    // of all tets of the ring
  const Candidate* old;
  bool is_sandwich;
  std::vector<Quality> old_sides;  // as the search takes them

  QualityVector vector_of(const Candidate& covering) const {
    QualityVector v;
    for (const unsigned t : covering.tets) v.push_back(qualities[t]);
    std::sort(v.begin(), v.end());
    return v;
  }
  bool is_new(unsigned t) const {
    return std::find(old->tets.begin(), old->tets.end(), t) == old->tets.end();
  }
  /// The lowest quality of the tets that the old mesh does not have.
  double worst_new(const Candidate& covering) const {
    double worst = std::numeric_limits<double>::infinity();
    for (const unsigned t : covering.tets) {
      if (is_sandwich || is_new(t)) worst = std::min(worst, qualities[t]);
    }
    return worst;
  }
  CoveringProblem problem(Quality floor) const {
    CoveringProblem problem;
    problem.a = points[ring->a()];
    problem.b = points[ring->b()];
    problem.ring = {points.data(), ring->m};
    problem.old_sides = old_sides;
    problem.floor = floor;
    return problem;
  }
  Quality worst_old() const { return static_cast<Quality>(vector_of(*old).front()); }
};

/// A shell has the old tets around ab, a sandwich the first triangulation with positive tets.
Case random_case(RingRandom& random, unsigned m, const Shape& shape, bool is_sandwich) {
  Case c = {&ring_of(m), shape.name, {}, {}, nullptr, is_sandwich, {}};
  while (c.old == nullptr) {
    c.points = random_ring_points(random, m, shape);
    c.qualities.clear();
    for (const RingTet& t : c.ring->tets) {
      c.qualities.push_back(
          minimum_sine(c.points[t[0]], c.points[t[1]], c.points[t[2]], c.points[t[3]]));
    }
    for (const Candidate& covering : c.ring->coverings) {
      const bool is_kind = covering.core.size() == (is_sandwich ? 0 : m);
      if (c.old == nullptr && is_kind && c.vector_of(covering).front() > 0) c.old = &covering;
    }
  }
  for (std::size_t i = 0; i < m && !is_sandwich; ++i) {
    c.old_sides.push_back(static_cast<Quality>(c.qualities[c.old->tets[i]]));
  }
  return c;
}

/// The search computes the same qualities by other operations, in single precision.
constexpr double kSearchTolerance = 1e-6;

/// Order of quality vectors cut to the `worst` lowest entries, a missing entry being +infinity: the
/// first entries that differ decide. 0 also if these are too close to tell.
int compare(const QualityVector& x, const QualityVector& y, unsigned worst) {
  for (unsigned i = 0; i < worst; ++i) {
    const double xi = i < x.size() ? x[i] : std::numeric_limits<double>::infinity();
    const double yi = i < y.size() ? y[i] : std::numeric_limits<double>::infinity();
    if (xi == yi) continue;
    if (std::abs(xi - yi) <= kSearchTolerance) return 0;
    return xi > yi ? 1 : -1;
  }
  return 0;
}

/// The best quality vectors among the coverings other than the old one.
struct Best {
  std::optional<QualityVector> full;
  std::optional<QualityVector> core;
};

bool obeys(const Candidate& covering, const std::vector<unsigned>& ancestors) {
  return std::none_of(ancestors.begin(), ancestors.end(),
                      [&](unsigned n) { return covering.grows[n]; });
}

/// Counts only what is above the floor for certain.
Best enumerate_best(const Case& c, Quality floor, const std::vector<unsigned>& ancestors) {
  Best best;
  for (const Candidate& covering : c.ring->coverings) {
    if (!c.is_sandwich && &covering == c.old) continue;
    if (!obeys(covering, ancestors)) continue;
    if (c.worst_new(covering) <= floor + kSearchTolerance) continue;
    std::optional<QualityVector>& seen = covering.core.empty() ? best.full : best.core;
    const QualityVector v = c.vector_of(covering);
    const bool better =
        !seen || std::lexicographical_compare(seen->begin(), seen->end(), v.begin(), v.end());
    if (better) seen = v;
  }
  return best;
}

/// The result of a search as one of the coverings of the ring; null if it is none of them.
const Candidate* identify(const Ring& ring, const Covering& covering) {
  Candidate found;
  found.core.assign(covering.core.begin(), covering.core.begin() + covering.degree);
  for (unsigned n = 0; n < covering.triangle_count; ++n) {
    const Covering::Triangle& t = covering.triangles[n];
    found.triangles.emplace_back(t.begin(), t.end());
  }
  const auto start_at_lowest = [](Chain& chain) {
    std::rotate(chain.begin(), std::min_element(chain.begin(), chain.end()), chain.end());
  };
  start_at_lowest(found.core);
  for (Chain& triangle : found.triangles) start_at_lowest(triangle);
  std::sort(found.triangles.begin(), found.triangles.end());
  for (const Candidate& other : ring.coverings) {
    if (other.core == found.core && other.triangles == found.triangles) return &other;
  }
  return nullptr;
}

/// What is wrong with the tets that a caller makes of a covering; empty if nothing is.
std::string fault_of_tets(const Case& c, const Covering& covering) {
  const Ring& ring = *c.ring;
  std::vector<RingTet> tets;
  for (unsigned n = 0; n < covering.triangle_count; ++n) {
    const auto [i, k, j] = covering.triangles[n];
    const bool in_ring_order = (i < k) + (k < j) + (j < i) == 2;
    if (!in_ring_order) return "a triangle is not in ring order";
    tets.push_back({ring.a(), i, k, j});
    tets.push_back({i, k, j, ring.b()});
  }
  for (unsigned n = 0; n < covering.degree; ++n) {
    tets.push_back({ring.a(), ring.b(), covering.core[n],
                    covering.core[n + 1 == covering.degree ? 0 : n + 1]});
  }
  if (tets.size() != covering.tet_count()) return "the number of tets is wrong";
  if (!faces_close(ring, tets)) return "the faces do not close";
  const auto volume = [&](const RingTet& t) {
    return volume6(c.points[t[0]], c.points[t[1]], c.points[t[2]], c.points[t[3]]);
  };
  double before = 0;
  double after = 0;
  for (const unsigned t : c.old->tets) before += volume(ring.tets[t]);
  for (const RingTet& t : tets) {
    if (volume(t) <= 0) return "a tet is not positive";
    after += volume(t);
  }
  return std::abs(after - before) <= 1e-12 * before ? "" : "the volume has changed";
}

struct Tally {
  unsigned full = 0;
  unsigned core = 0;
  unsigned none = 0;
};

/// Runs a search. It must find the best full triangulation, unless a core is better: the best core
/// where that is better than the old mesh. A core that is not better may be missed, because the
/// cycle search then ends at the old mesh. Whatever is found must be valid.
template <unsigned Worst>
std::string fault_of_search(const Case& c, const Best& best, const CoveringProblem& problem,
                            const std::vector<unsigned>& ancestors, Tally& tally) {
  static BasicCoveringSearch<Worst> search;
  std::optional<QualityVector> required = best.full;
  const bool core_counts = problem.allow_core && best.core &&
                           (c.is_sandwich || compare(*best.core, c.vector_of(*c.old), Worst) > 0);
  if (core_counts && (!required || compare(*best.core, *required, Worst) > 0)) required = best.core;

  Covering covering;
  if (!search.run(problem, covering)) {
    ++tally.none;
    return required ? "a covering is missed" : "";
  }
  ++(covering.degree > 0 ? tally.core : tally.full);
  const Candidate* found = identify(*c.ring, covering);
  if (found == nullptr) return "no covering of the ring";
  if (!c.is_sandwich && found == c.old) return "the old mesh";
  if (!problem.allow_core && covering.degree > 0) return "a core where none is allowed";
  if (!obeys(*found, ancestors)) return "an ancestor edge has a new face";
  if (c.worst_new(*found) <= problem.floor - kSearchTolerance)
    return "a new tet is not above the floor";
  if (required && compare(c.vector_of(*found), *required, Worst) < 0)
    return "not the best covering";
  return fault_of_tets(c, covering);
}

struct Tallies {
  Tally exact;
  Tally three;
  Tally one;
  Tally no_core;
};

void check_searches(const Case& c, Quality floor, const std::vector<unsigned>& ancestors,
                    Tallies& tallies) {
  constexpr unsigned kAll = 2 * kMaxSearchRing;
  const Best best = enumerate_best(c, floor, ancestors);
  CoveringProblem problem = c.problem(floor);
  for (const unsigned n : ancestors) lock(*c.ring, n, problem);
  std::vector<std::string> faults = {
      fault_of_search<kAll>(c, best, problem, ancestors, tallies.exact),
      fault_of_search<3>(c, best, problem, ancestors, tallies.three),
      fault_of_search<1>(c, best, problem, ancestors, tallies.one)};
  problem.allow_core = false;
  faults.push_back(fault_of_search<kAll>(c, best, problem, ancestors, tallies.no_core));
  faults.push_back(fault_of_search<3>(c, best, problem, ancestors, tallies.no_core));
  faults.push_back(fault_of_search<1>(c, best, problem, ancestors, tallies.no_core));
  const std::vector<std::string> none(faults.size());
  REQUIRE_MESSAGE(faults == none, "ring of ", c.ring->m, ", ", c.shape, ", floor ", floor, ", ",
                  ancestors.size(), " ancestors; exact, 3, 1, and the same without core: ",
                  doctest::toString(faults[0] + "; " + faults[1] + "; " + faults[2] + "; " +
                                    faults[3] + "; " + faults[4] + "; " + faults[5]));
}

/// A test of random cases says little unless all kinds of results are frequent.
void check_variety(const Tallies& tallies) {
  for (const Tally& tally : {tallies.exact, tallies.three, tallies.one}) {
    CHECK(tally.full > 2000);
    CHECK(tally.core > 1000);
    CHECK(tally.none > 2000);
  }
  CHECK(tallies.no_core.core == 0);
  CHECK(tallies.no_core.full > 2000);
  CHECK(tallies.no_core.none > 2000);
}

constexpr unsigned kCases = 3000;  // per ring size

std::uint64_t binomial(unsigned n, unsigned k) {
  std::uint64_t value = 1;
  for (unsigned i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

}  // namespace

TEST_CASE("The enumeration lists every covering of a ring once, with faces that close") {
  for (unsigned m = kSmallest; m <= kLargest; ++m) {
    CAPTURE(m);
    const Ring& ring = ring_of(m);
    // Catalan's triangulations, and with a core of n vertices (2m-n-1 over m-1).
    std::uint64_t expected = binomial(2 * m - 4, m - 2) / (m - 1);
    for (unsigned n = 3; n <= m; ++n) expected += binomial(2 * m - n - 1, m - 1);
    CHECK(ring.coverings.size() == expected);
    std::set<std::pair<Chain, std::vector<Chain>>> distinct;
    for (const Candidate& covering : ring.coverings) {
      distinct.emplace(covering.core, covering.triangles);
      REQUIRE(faces_close(ring, tets_of(ring, covering)));
    }
    CHECK(distinct.size() == expected);
  }
}

TEST_CASE("Locked vertices and edges forbid just the coverings with new faces at ancestor edges") {
  for (unsigned m = kSmallest; m <= kLargest; ++m) {
    const Ring& ring = ring_of(m);
    for (const Candidate& covering : ring.coverings) {
      // Locks by the rule: chords end at the vertex, or a triangle uses the ring edge.
      std::vector<bool> chord_at(m);
      std::vector<bool> pocket_at(m);
      std::vector<Chain> cells = covering.triangles;
      if (!covering.core.empty()) cells.push_back(covering.core);
      for (const Chain& cell : cells) {
        for (std::size_t n = 0; n < cell.size(); ++n) {
          const unsigned i = cell[n];
          const unsigned j = cell[(n + 1) % cell.size()];
          if (!ring.is_ring_side(i, j)) {
            chord_at[i] = chord_at[j] = true;
          } else if (cell != covering.core) {
            pocket_at[i] = true;
          }
        }
      }
      std::vector<bool> rule = chord_at;
      rule.insert(rule.end(), chord_at.begin(), chord_at.end());
      rule.insert(rule.end(), pocket_at.begin(), pocket_at.end());
      REQUIRE(rule == covering.grows);
    }
  }
}

TEST_CASE("A random shell without ancestors gets the best of all its coverings") {
  RingRandom random(1);
  Tallies tallies;
  for (unsigned m = kSmallest; m <= kLargest; ++m) {
    for (unsigned n = 0; n < kCases; ++n) {
      const Case c = random_case(random, m, kShellShapes[n % kShellShapes.size()], false);
      check_searches(c, 0, {}, tallies);
      check_searches(c, c.worst_old(), {}, tallies);
    }
  }
  check_variety(tallies);
}

TEST_CASE("A random shell below ancestor edges gets the best covering without new faces there") {
  RingRandom random(2);
  Tallies tallies;
  for (unsigned m = kSmallest; m <= kLargest; ++m) {
    for (unsigned n = 0; n < kCases; ++n) {
      const Case c = random_case(random, m, kShellShapes[n % kShellShapes.size()], false);
      std::vector<unsigned> ancestors(1 + random.below(3));
      for (unsigned& ancestor : ancestors) ancestor = random.below(3 * m);
      check_searches(c, 0, ancestors, tallies);
      check_searches(c, c.worst_old(), ancestors, tallies);
    }
  }
  check_variety(tallies);
}

TEST_CASE("A random sandwich gets the best of all coverings of its polygon") {
  RingRandom random(3);
  Tallies tallies;
  for (unsigned m = kSmallest; m <= kLargest; ++m) {
    for (unsigned n = 0; n < kCases; ++n) {
      const Case c = random_case(random, m, kSandwichShapes[n % kSandwichShapes.size()], true);
      check_searches(c, 0, {}, tallies);
      check_searches(c, c.worst_old(), {}, tallies);
    }
  }
  check_variety(tallies);
}

TEST_CASE(
    "A floor just below the worst tet of the best covering keeps it, one just above does not") {
  RingRandom random(4);
  ExactCoveringSearch search;
  unsigned found = 0;
  for (unsigned m = kSmallest; m <= kLargest; ++m) {
    for (unsigned n = 0; n < kCases; ++n) {
      const Case c = random_case(random, m, kSandwichShapes[n % kSandwichShapes.size()], true);
      const Best best = enumerate_best(c, 0, {});
      const double full = best.full ? best.full->front() : 0;
      const double core = best.core ? best.core->front() : 0;
      for (const bool allow_core : {false, true}) {
        const double worst = allow_core ? std::max(full, core) : full;
        if (worst == 0) continue;
        ++found;
        CoveringProblem problem = c.problem(static_cast<Quality>(worst - kSearchTolerance));
        problem.allow_core = allow_core;
        Covering covering;
        REQUIRE(search.run(problem, covering));
        const Candidate* kept = identify(*c.ring, covering);
        REQUIRE(kept != nullptr);
        REQUIRE(std::abs(c.vector_of(*kept).front() - worst) <= kSearchTolerance);
        problem.floor = static_cast<Quality>(worst + kSearchTolerance);
        REQUIRE_FALSE(search.run(problem, covering));
      }
    }
  }
  CHECK(found > 10000);
}
