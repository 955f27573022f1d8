// SPDX-License-Identifier: MIT
// Sums over the tets around each vertex: the shares of tets are computed four at a time, and added to
// the vertices in the order of the tets, both by all threads.
//
//   estimate of CG steps: 8 (g^2 / lambda)^(3/8), whose powers and factor are fitted
//     g       largest row sum of |K| scaled by its diagonal, of inner vertices, over their tets one
//             by one: large where tets are flat; about the largest eigenvalue of the scaled matrix
//     lambda  u'Ku / u'Du, D the diagonal of K, for u = edges on the way to the surface: about the
//             smallest eigenvalue
#include "kernel/solver_rulers.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <tbb/task_arena.h>

#include "kernel/chunks.h"
#include "kernel/compensated_sum.h"
#include "kernel/index_set.h"
#include "kernel/star.h"
#include "kernel/tet_rows.h"

namespace tetmend {

namespace {

constexpr std::size_t kGroups = PointRows<4>::kMost / kWideLanes;

template <std::size_t N>
using Shares = std::array<WideRows<N>, kGroups>;

/// Tets whose shares are computed by one thread.
constexpr std::size_t kTetsOfChunk = kChunkSize / 4;

/// The vertices in at most 64 ranges, for sums at the vertices by several threads.
class VertexRanges {
 public:
  using Set = std::uint64_t;  // a bit for each

  explicit VertexRanges(const TetMesh& mesh) {
    while ((mesh.vertex_slots() >> shift_) >= 64) ++shift_;
    count_ = (mesh.vertex_slots() >> shift_) + 1;
  }
  std::size_t count() const { return count_; }
  std::size_t find(VertexHandle v) const { return v.index() >> shift_; }
  Set find(const TetVertices& v) const {
    return Set{1} << find(v[0]) | Set{1} << find(v[1]) | Set{1} << find(v[2]) |
           Set{1} << find(v[3]);
  }

 private:
  unsigned shift_ = 14;  // less work than that is not worth a thread
  std::size_t count_;
};

/// The shares of some tets in what their vertices have. First one chunk of tets a thread, then one
/// range of vertices: so each sum runs in the order of the tets, on any number of threads.
template <std::size_t N>
class SharesOfTets {
 public:
  explicit SharesOfTets(const TetMesh& mesh) : mesh_(mesh), ranges_(mesh) {
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    if (threads == 1) return;  // needs no memory of shares
    at_once_ = std::min(4 * threads * kTetsOfChunk, mesh.tet_slots());
    shares_.resize(at_once_);
    sets_.resize(chunk_count(at_once_, kOfBlock));
  }

  /// Calls compute(chunk, rows, shares) for blocks of tets, then add(v, corner, shares) for the
  /// vertices of all tets, with the N numbers of the tet.
  template <class Compute, class Add>
  void visit(const Compute& compute, const Add& add) {
    if (at_once_ == 0) return visit_alone(compute, add);
    for (std::size_t first = 0; first < mesh_.tet_slots(); first += at_once_) {
      const std::size_t size = std::min(at_once_, mesh_.tet_slots() - first);
      for_chunks(
          size,
          [&](std::size_t begin, std::size_t end) {
            for (; begin < end; begin += kOfBlock) {
              compute_block(first, begin, std::min(end, begin + kOfBlock), compute);
            }
          },
          kTetsOfChunk);
      for_chunks(
          ranges_.count(),
          [&](std::size_t range, std::size_t) {
            for (std::size_t begin = 0; begin < size; begin += kOfBlock) {
              add_block(first, begin, std::min(size, begin + kOfBlock), range, add);
            }
          },
          1);
    }
  }

 private:
  static constexpr std::size_t kOfBlock = PointRows<4>::kMost;

  /// On one thread: the same sums in the same order.
  template <class Compute, class Add>
  void visit_alone(const Compute& compute, const Add& add) const {
    for (std::size_t begin = 0; begin < mesh_.tet_slots(); begin += kOfBlock) {
      const std::size_t end = std::min(mesh_.tet_slots(), begin + kOfBlock);
      visit_rows(mesh_, begin, end, 1, [&](const TetRows& rows) {
        Shares<N> shares;
        compute(begin / kTetsOfChunk, rows, shares);
        for (std::size_t i = 0; i < rows.points.size(); ++i) {
          const TetVertices& v = mesh_.vertices(rows.tets[i]);
          std::array<double, N> share;
          for (std::size_t k = 0; k < N; ++k)
            share[k] = shares[i / kWideLanes].of[k][i % kWideLanes];
          for (std::size_t k = 0; k < 4; ++k) add(v[k].index(), k, share);
        }
      });
    }
  }

  template <class Compute>
  void compute_block(std::size_t first, std::size_t begin, std::size_t end,
                     const Compute& compute) {
    VertexRanges::Set& set = sets_[begin / kOfBlock] = 0;
    visit_rows(mesh_, first + begin, first + end, 1, [&](const TetRows& rows) {
      Shares<N> shares;
      compute((first + begin) / kTetsOfChunk, rows, shares);
      for (std::size_t i = 0; i < rows.points.size(); ++i) {
        set |= ranges_.find(mesh_.vertices(rows.tets[i]));
        std::array<double, N>& to = shares_[rows.tets[i].index() - first];
        for (std::size_t k = 0; k < N; ++k) to[k] = shares[i / kWideLanes].of[k][i % kWideLanes];
      }
    });
  }

  template <class Add>
  void add_block(std::size_t first, std::size_t begin, std::size_t end, std::size_t range,
                 const Add& add) const {
    const VertexRanges::Set set = sets_[begin / kOfBlock];
    const VertexRanges::Set own = VertexRanges::Set{1} << range;
    if ((set & own) == 0) return;
    const bool owns_all = set == own;
    for (std::size_t i = begin; i < end; ++i) {
      const TetHandle t(static_cast<std::uint32_t>(first + i));
      if (mesh_.is_deleted(t)) continue;
      const TetVertices& v = mesh_.vertices(t);
      for (std::size_t k = 0; k < 4; ++k) {
        if (owns_all || ranges_.find(v[k]) == range) add(v[k].index(), k, shares_[i]);
      }
    }
  }

  const TetMesh& mesh_;
  VertexRanges ranges_;
  std::size_t at_once_ = 0;                    // slots, in whole chunks; 0: one thread
  std::vector<std::array<double, N>> shares_;  // by slot
  std::vector<VertexRanges::Set> sets_;        // by block
};

/// Normals of the four faces, twice the areas long, and six volumes.
struct WideFaces {
  std::array<WidePoint, 4> normal;
  WideVector v6;
};

TETMEND_WIDE_INLINE WideFaces faces_of(const PointRows<4>& rows, std::size_t g) {
  const WidePoint p0 = wide_point(rows.group(g), 0), p1 = wide_point(rows.group(g), 1);
  const WidePoint p2 = wide_point(rows.group(g), 2), p3 = wide_point(rows.group(g), 3);
  const WidePoint u = p1 - p0, v = p2 - p0, w = p3 - p0;
  const WidePoint b = cross(v, w);
  return {{cross(p3 - p1, p2 - p1), b, cross(w, u), cross(u, v)}, dot(u, b)};
}

/// Mass of a vertex, then the diagonal of the stiffness matrix. True if all masses are positive.
TETMEND_WIDE bool compute_diagonals(const PointRows<4>& rows, Shares<5>& shares) {
  bool are_positive = true;
  for (std::size_t g = 0; g < rows.groups(); ++g) {
    const WideFaces faces = faces_of(rows, g);
    WideVector* const to = shares[g].vectors();
    const WideVector scale = 1.0 / (6.0 * faces.v6);
    to[0] = faces.v6 / 24.0;
    const auto positive = to[0] > 0.0;
    are_positive = are_positive && (positive[0] & positive[1] & positive[2] & positive[3]) != 0;
    for (std::size_t i = 0; i < 4; ++i) {
      to[i + 1] = scale * dot(faces.normal[i], faces.normal[i]);
    }
  }
  return are_positive;
}

/// Of a vertex: a scale, and edges on the way to the surface.
struct ScaleAndDepth {
  double scale = 0;
  double depth = 0;
};

/// Of the vertices of a block of tets.
struct VertexRows {
  std::array<WideRows<4>, kGroups> scale{};
  std::array<WideRows<4>, kGroups> depth{};
};

/// The product of the stiffness matrix, without signs, and the scale. Adds the energy of `depth`.
TETMEND_WIDE void compute_products(const PointRows<4>& rows, const VertexRows& vertices,
                                   Shares<4>& shares, WideSum& energy) {
  for (std::size_t g = 0; g < rows.groups(); ++g) {
    const auto in_use = lanes_in_use(rows, g);
    const WideFaces faces = faces_of(rows, g);
    const WideVector* const scale = vertices.scale[g].vectors();
    const WideVector* const depth = vertices.depth[g].vectors();
    WideVector* const to = shares[g].vectors();
    const WideVector inverse = 1.0 / (6.0 * faces.v6);
    WidePoint gradient = {};
    for (std::size_t i = 0; i < 4; ++i) {
      const WidePoint& n = faces.normal[i];
      WideVector sum = {};
      for (std::size_t j = 0; j < 4; ++j) {
        sum += magnitude(dot(n, faces.normal[j])) * scale[j];
      }
      to[i] = inverse * sum;
      const WideVector rise = depth[i] - depth[0];
      gradient = {gradient.x + rise * n.x, gradient.y + rise * n.y, gradient.z + rise * n.z};
    }
    add_to(energy, in_use ? inverse * dot(gradient, gradient) : WideVector{});
  }
}

constexpr auto kRelaxed = std::memory_order_relaxed;
constexpr std::uint32_t kNotReached = std::numeric_limits<std::uint32_t>::max() / 2;

/// By vertex: the number of edges on the way to the surface. The tets of a level are those whose
/// nearest vertex has its depth: their other vertices are one edge farther. All threads work on a
/// level at once, and in it write the same numbers: only who comes first is left to chance.
class Depths {
 public:
  using Depth = std::atomic<std::uint32_t>;

  explicit Depths(const TetMesh& mesh)
      : mesh_(mesh), depths_(mesh.vertex_slots()), reached_(mesh.tet_slots()) {
    for (std::uint32_t i = 0; i < depths_.size(); ++i) {
      depths_[i].store(mesh.is_boundary(VertexHandle(i)) ? 0 : kNotReached, kRelaxed);
    }
  }

  std::vector<Depth> find() {
    level_ = tets_at_surface();
    for (std::uint32_t depth = 0; !level_.empty(); ++depth) {
      farther_.clear();
      while (!level_.empty()) spread(depth);
      for (const TetHandle t : farther_) {
        if (is_first(t)) level_.push_back(t);
      }
    }
    return std::move(depths_);
  }

 private:
  struct Found {
    std::vector<TetHandle> level;    // more tets of the level
    std::vector<TetHandle> farther;  // of the next one, unless they turn out to be of this one
  };

  std::vector<TetHandle> tets_at_surface() {
    const auto parts = map_chunks<std::vector<TetHandle>>(
        mesh_.tet_slots(),
        [&](std::size_t begin, std::size_t end) {
          std::vector<TetHandle> part;
          for (std::size_t i = begin; i < end; ++i) {
            const TetHandle t(static_cast<std::uint32_t>(i));
            if (mesh_.is_deleted(t)) continue;
            const TetVertices& v = mesh_.vertices(t);
            const auto is_at_surface = [&](VertexHandle w) {
              return depths_[w.index()].load(kRelaxed) == 0;
            };
            if (std::any_of(v.begin(), v.end(), is_at_surface) && is_first(t)) part.push_back(t);
          }
          return part;
        },
        kTetsOfChunk);
    std::vector<TetHandle> tets;
    for (const auto& part : parts) tets.insert(tets.end(), part.begin(), part.end());
    return tets;
  }

  /// Two threads may both be first: then the tet is looked at twice, which changes nothing.
  bool is_first(TetHandle t) {
    if (reached_[t.index()].load(kRelaxed) != 0) return false;
    mark(t);
    return true;
  }
  void mark(TetHandle t) { reached_[t.index()].store(1, kRelaxed); }

  /// From the tets of the level to their neighbours, which are the next to be looked at.
  void spread(std::uint32_t depth) {
    const std::vector<TetHandle> tets = std::exchange(level_, {});
    const auto parts = map_chunks<Found>(
        tets.size(),
        [&](std::size_t begin, std::size_t end) {
          Found found;
          for (std::size_t i = begin; i < end; ++i) look_around(tets[i], depth, found);
          return found;
        },
        kTetsOfChunk);
    for (const Found& part : parts) {
      level_.insert(level_.end(), part.level.begin(), part.level.end());
      farther_.insert(farther_.end(), part.farther.begin(), part.farther.end());
    }
  }

  void look_around(TetHandle t, std::uint32_t depth, Found& found) {
    Depth* const depths = depths_.data();  // stores of others do not change where they are
    const std::atomic<char>* const reached = reached_.data();
    const TetVertices& v = mesh_.vertices(t);
    unsigned nearest = 0;  // a bit for each vertex of that depth
    for (unsigned k = 0; k < 4; ++k) {
      const std::uint32_t now = depths[v[k].index()].load(kRelaxed);
      nearest |= now == depth ? 1u << k : 0u;
      if (now > depth + 1) depths[v[k].index()].store(depth + 1, kRelaxed);
    }
    const auto& twins = mesh_.neighbours(t);
    for (unsigned f = 0; f < 4; ++f) {
      if (twins[f].is_outside()) continue;
      const TetHandle other = twins[f].tet();
      if (reached[other.index()].load(kRelaxed) != 0) continue;
      mesh_.prefetch(other);
      const bool is_of_level = (nearest & ~(1u << f)) != 0;
      if (is_of_level) mark(other);
      (is_of_level ? found.level : found.farther).push_back(other);
    }
  }

  const TetMesh& mesh_;
  std::vector<Depth> depths_;               // by vertex
  std::vector<std::atomic<char>> reached_;  // by tet
  std::vector<TetHandle> level_;            // still to be looked at
  std::vector<TetHandle> farther_;
};

}  // namespace

P1Diagonals p1_diagonals(const TetMesh& mesh) {
  P1Diagonals sums;
  sums.mass.resize(mesh.vertex_slots());
  sums.stiffness.resize(mesh.vertex_slots());
  std::vector<char> has_others(chunk_count(mesh.tet_slots(), kTetsOfChunk));  // not positive
  SharesOfTets<5>(mesh).visit(
      [&](std::size_t chunk, const TetRows& rows, Shares<5>& shares) {
        if (!compute_diagonals(rows.points, shares)) has_others[chunk] = 1;
      },
      [&](std::uint32_t v, std::size_t corner, const std::array<double, 5>& share) {
        sums.mass[v] += share[0];
        sums.stiffness[v] += share[corner + 1];
      });
  sums.are_positive = mesh.tet_count() > 0 &&
                      std::find(has_others.begin(), has_others.end(), 1) == has_others.end();
  return sums;
}

double stable_step(const P1Diagonals& diagonals) {
  if (!diagonals.are_positive) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < diagonals.mass.size(); ++i) {
    const VertexHandle v(static_cast<std::uint32_t>(i));
    if (diagonals.is_in_use(v)) least = std::min(least, diagonals.step(v));
  }
  return least;
}

double stable_step(const TetMesh& mesh) {
  return stable_step(p1_diagonals(mesh));
}

double estimate_cg_steps(const TetMesh& mesh, const P1Diagonals& diagonals) {
  constexpr double kFactor = 8;
  if (!diagonals.are_positive) return 0;
  const std::vector<Depths::Depth> depths = Depths(mesh).find();
  std::vector<ScaleAndDepth> vertices(depths.size());
  CompensatedSum squares;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const double depth = depths[i].load(kRelaxed);
    vertices[i].depth = depth;
    if (depth == 0 || !diagonals.is_in_use(VertexHandle(static_cast<std::uint32_t>(i)))) continue;
    vertices[i].scale = 1 / std::sqrt(diagonals.stiffness[i]);
    squares.add(diagonals.stiffness[i] * depth * depth);
  }
  std::vector<double> rows(depths.size());
  std::vector<CompensatedSum> energies(chunk_count(mesh.tet_slots(), kTetsOfChunk));
  SharesOfTets<4>(mesh).visit(
      [&](std::size_t chunk, const TetRows& tets, Shares<4>& shares) {
        VertexRows of;
        for (std::size_t i = 0; i < tets.points.size(); ++i) {
          const TetVertices& v = mesh.vertices(tets.tets[i]);
          for (std::size_t k = 0; k < 4; ++k) {
            const auto& [scale, depth] = vertices[v[k].index()];
            of.scale[i / kWideLanes].of[k][i % kWideLanes] = scale;
            of.depth[i / kWideLanes].of[k][i % kWideLanes] = depth;
          }
        }
        WideSum energy;
        compute_products(tets.points, of, shares, energy);
        energies[chunk].add(energy.total());
      },
      [&](std::uint32_t v, std::size_t corner, const std::array<double, 4>& share) {
        rows[v] += share[corner];
      });
  CompensatedSum energy;
  for (const CompensatedSum& part : energies) energy.add(part);
  double largest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    largest = std::max(largest, vertices[i].scale * rows[i]);
  if (largest == 0) return 0;  // no inner vertex
  const double condition = largest * largest * squares.value() / energy.value();
  const double fourth = std::sqrt(std::sqrt(condition));
  return kFactor * fourth * std::sqrt(fourth);  // the power 3/8, the same on every machine
}

std::optional<double> squared_step_at(const TetMesh& mesh, VertexHandle v) {
  thread_local IndexSet seen;
  thread_local std::vector<TetHandle> star;
  seen.clear();
  star.assign(1, mesh.tet_of(v));
  seen.insert(star[0].index());
  double mass = 0;
  double stiffness = 0;
  for (std::size_t i = 0; i < star.size(); ++i) {
    const TetHandle t = star[i];
    const TetVertices& corners = mesh.vertices(t);
    unsigned at = 0;
    while (corners[at] != v) ++at;
    const auto& [j, k, l] = kFaceVertices[at];
    const Point& p = mesh.point(corners[j]);
    const Point normal = (mesh.point(corners[k]) - p).cross(mesh.point(corners[l]) - p);
    const double v6 = normal.dot(mesh.point(v) - p);
    mass += std::abs(v6) / 24;
    stiffness += normal.squaredNorm() / (6 * std::abs(v6));
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      if (f == at || mesh.is_boundary(face)) continue;
      const TetHandle next = mesh.twin(face).tet();
      if (seen.insert(next.index())) star.push_back(next);
    }
    if (star.size() > kMaxStar) return std::nullopt;
  }
  return mass / stiffness;
}

}  // namespace tetmend
