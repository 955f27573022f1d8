// SPDX-License-Identifier: MIT
// The best covering mesh of a shell by dynamic programming ([chen, Alg. 1-3]). A pure unit: points
// in, triangles and core out.
//
//         p_2 ------- p_1         A shell, seen along its edge ab. A covering cuts pockets off the
//        / pocket .--'  \         ring and triangulates them: a triangle (p_i, p_k, p_j) gives the
//       /    .--'        \        tets (a, p_i, p_k, p_j) and (p_i, p_k, p_j, b). What is left of
//     p_3--'     ab      p_0      the ring is the core, each side (p_i, p_j) of which gives the tet
//       \                /        (a, b, p_i, p_j). Without a core the edge ab is gone: full
//        \     core     /         reduction. Tets that are all positive fill the shell without
//         p_4 ------- p_5         overlap.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "kernel/quality.h"

namespace tetmend {

/// Largest ring that is searched; the tables grow with its cube.
inline constexpr unsigned kMaxSearchRing = 16;

struct CoveringProblem {
  Point a;
  Point b;
  /// 3 to kMaxSearchRing points; (a, b, ring[i], ring[i+1]) is positive in a real shell.
  std::span<const Point> ring;
  /// Qualities of the tets (a, b, ring[i], ring[i+1]) as they are. Empty for the virtual shell of a
  /// face removal, where no tet contains ab and each side of the core is a new tet.
  std::span<const Quality> old_sides;
  Standard standard;  ///< by which tets are judged
  /// Every new tet must be better than this. The worst quality of the old tets loses nothing.
  Quality floor = 0;
  /// Ancestor edges, as bits: no chord may end at a locked ring vertex, no pocket may use a locked
  /// ring edge (i, i+1).
  std::uint32_t locked_vertices = 0;
  std::uint32_t locked_edges = 0;
  bool allow_core = true;  ///< false: full reduction only, which is edge removal
};

struct Covering {
  using Triangle = std::array<std::uint8_t, 3>;  ///< ring indices, in ring order

  unsigned triangle_count = 0;
  std::array<Triangle, kMaxSearchRing> triangles;
  unsigned degree = 0;  ///< of ab afterwards: number of core vertices, 0 for full reduction
  std::array<std::uint8_t, kMaxSearchRing> core;

  unsigned tet_count() const { return 2 * triangle_count + degree; }
};

/// Tables of the search, re-used from call to call. `Worst` is the number of worst qualities by
/// which coverings are ranked: the search is exact for the quality vectors cut to that length,
/// compared lexicographically with +infinity as padding.
template <unsigned Worst>
class BasicCoveringSearch {
 public:
  /// Finds the best covering other than the old one. False if there is none above the floor. A
  /// covering with a core may be missed if it does not rank above the old mesh. Ties of whole
  /// vectors go to the smaller degree, then to the lower indices. Cost: O(m^3) for ring size m, no
  /// memory.
  bool run(const CoveringProblem& problem, Covering& best);

  /// The worst qualities of some tets, ascending, padded with +infinity: what is ranked.
  using Ranking = std::array<Quality, Worst>;
  /// Finds the best triangulation of each pocket as run() does, and no covering: for whoever shows
  /// what a search sees. pocket() reads them. Cost: as run().
  void explore(const CoveringProblem& problem);
  /// The best triangulation of the pocket that goes from ring vertex i over d sides; nothing if none
  /// is above the floor, or if its chord is locked.
  /// Preconditions: explore() was called last, and 2 <= d <= m - 2, or i = 0 and d = m - 1 for the
  /// whole ring of size m.
  std::optional<Ranking> pocket(unsigned i, unsigned d) const;

  /// Triangles and core sides that the last run evaluated.
  unsigned evaluations() const { return evaluations_; }

 private:
  /// The worst qualities in ascending order, padded with +infinity.
  struct Values {
    Ranking v;
    static Values best() {
      Values values;
      values.v.fill(std::numeric_limits<Quality>::infinity());
      return values;
    }
    bool better_than(const Values& other) const;
    void add(Quality q);
    void add(const Values& other);
  };
  struct Pocket {  // best triangulation of the chain i .. i + d
    Values values;
    std::uint8_t apex;
    bool valid;
  };
  // The core is a cycle of arcs. Arc [i][d] goes from i to i + d; its value is the quality of the
  // side of the core, or 0 if there is none.
  using Arcs = std::array<std::array<Quality, kMaxSearchRing>, kMaxSearchRing>;
  struct Way {  // the best from the first vertex of a cycle to another
    Values values;
    std::uint8_t previous;  // vertices before it
    std::uint8_t sides;
    bool valid;
    bool changed;  // some side is new
  };
  using Ways = std::array<Way, kMaxSearchRing + 1>;
  // What most searches never ask for is computed when first asked for; it counts for the run whose
  // number it carries.
  struct Triangle {
    Quality upper;
    Quality lower;
    bool valid;
    std::uint32_t run = 0;
  };
  struct Pair {  // of ring vertices
    double length2;
    double normal_a;  // squared norm of the normal of the face with a
    double normal_b;
    std::uint32_t run = 0;
  };

  void begin(const CoveringProblem& problem);
  Quality above_floor(double v6, double smallest, double product, double sum) const;
  Quality uneven_above_floor(const Point& a, const Point& b, const Point& c, const Point& d) const;
  const Pair& pair(unsigned low, unsigned high);
  const Triangle& triangle(unsigned i, unsigned k, unsigned j);
  Quality side(unsigned i, unsigned j);
  void evaluate(Triangle& t, unsigned i, unsigned k, unsigned j);
  bool fill_pockets(const CoveringProblem& problem);
  void fill_pocket(const CoveringProblem& problem, unsigned i, unsigned d);
  bool find_core(const CoveringProblem& problem, Values& values, Covering& covering);
  unsigned list_arcs(const CoveringProblem& problem, Arcs& arcs);
  void find_ways(const Arcs& arcs, bool is_virtual, unsigned start, Ways& ways) const;
  void take_core(const Ways& ways, unsigned start, Covering& covering) const;
  static bool is_better(const Values& values, unsigned degree, const Values& other,
                        unsigned other_degree);
  void add_triangles(unsigned i, unsigned d, Covering& covering) const;
  unsigned wrap(unsigned i) const { return i >= size_ ? i - size_ : i; }

  unsigned size_ = 0;
  Standard standard_;
  double weight_ = 1;       // of the sines that refuse a triangle at sight
  bool by_points_ = false;  // qualities come from the points alone, not from squares shared
  Quality floor_ = 0;
  unsigned evaluations_ = 0;
  Point a_;
  Point b_;
  std::array<Point, kMaxSearchRing> p_;
  std::array<Point, kMaxSearchRing> from_a_, from_b_;
  // Squared lengths, and squared norms of face normals.
  double ab2_ = 0;
  std::array<double, kMaxSearchRing> a2_, b2_, normal_ab_;
  std::uint32_t run_ = 0;
  std::array<std::array<Pair, kMaxSearchRing>, kMaxSearchRing> pairs_;      // [low][high]
  std::array<std::array<Pocket, kMaxSearchRing>, kMaxSearchRing> pockets_;  // [i][d]
  std::array<Triangle, kMaxSearchRing*(kMaxSearchRing - 1) * (kMaxSearchRing - 2) / 6> triangles_;
};

/// Ranks by the three worst values, which decide nearly always; callers compare whole vectors
/// before they accept.
using CoveringSearch = BasicCoveringSearch<3>;
/// Ranks by whole vectors for rings of up to 16.
using ExactCoveringSearch = BasicCoveringSearch<2 * kMaxSearchRing>;

extern template class BasicCoveringSearch<1>;
extern template class BasicCoveringSearch<3>;
extern template class BasicCoveringSearch<2 * kMaxSearchRing>;

}  // namespace tetmend
