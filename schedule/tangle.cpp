// SPDX-License-Identifier: MIT
//   inverted tets -> groups whose stars share one -> those with enough of them -> rings around
//   -> connected parts
#include "schedule/tangle.h"

#include <algorithm>
#include <limits>
#include <span>

#include "kernel/chunks.h"
#include "kernel/star.h"

namespace tetmend {

namespace {

bool is_inverted(const TetMesh& mesh, TetHandle t) {
  return mesh.quality(t) <= 0;
}

std::vector<TetHandle> list_inverted(const TetMesh& mesh) {
  constexpr Quality kLeastAboveZero = std::numeric_limits<Quality>::denorm_min();
  std::vector<TetHandle> all;
  const auto part = [&](std::size_t begin, std::size_t end) {
    std::vector<TetHandle> found;
    mesh.visit_below(kLeastAboveZero, begin, end, [&](TetHandle t) {
      if (!mesh.is_frozen(t)) found.push_back(t);
    });
    return found;
  };
  for (const auto& found : map_chunks<std::vector<TetHandle>>(mesh.tet_slots(), part)) {
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

/// Walks over a mesh, and what they have seen.
class TangleFinder {
 public:
  TangleFinder(const TetMesh& mesh, const TangleLimits& limits,
               const std::function<bool()>& proceed)
      : mesh_(mesh), limits_(limits), proceed_(proceed) {}

  std::vector<Tangle> find() {
    const std::vector<TetHandle> inverted = list_inverted(mesh_);
    if (inverted.size() < std::max<std::size_t>(limits_.at_least, 1)) return {};
    std::vector<VertexHandle> seeds;
    forget();
    for (const TetHandle t : inverted) gather(t, seeds);
    if (seeds.empty() || stopped_) return {};
    return divide(grow(std::move(seeds)));
  }

 private:
  /// Calls visit(tet) for the tets around a vertex, unless the search is to end.
  template <class Visit>
  void visit_star(VertexHandle v, const Visit& visit) {
    constexpr std::size_t kStarsBetweenLooks = 256;
    if (++stars_ % kStarsBetweenLooks == 0) stopped_ = stopped_ || !proceed_();
    if (stopped_) return;
    for (const TetHandle t : star(mesh_, v)) visit(t);
  }

  /// Appends the free vertices of a tet that were not seen.
  void take_vertices(TetHandle t, std::vector<VertexHandle>& out) {
    for (const VertexHandle v : mesh_.vertices(t)) {
      if (mesh_.is_fixed(v) || seen_vertex_[v.index()]) continue;
      seen_vertex_[v.index()] = true;
      out.push_back(v);
    }
  }

  /// The group of an inverted tet, if it was not seen: appends its free vertices if it is a tangle.
  void gather(TetHandle first, std::vector<VertexHandle>& out) {
    std::vector<VertexHandle> group;
    take_vertices(first, group);
    std::size_t tets = 0;
    std::size_t inverted = 0;
    for (std::size_t i = 0; i < group.size(); ++i) {
      visit_star(group[i], [&](TetHandle t) {
        if (seen_tet_[t.index()]) return;
        seen_tet_[t.index()] = true;
        ++tets;
        if (!is_inverted(mesh_, t)) return;
        ++inverted;
        take_vertices(t, group);
      });
    }
    const auto least = limits_.share * static_cast<double>(tets);
    if (inverted == 0 || inverted < limits_.at_least) return;
    if (static_cast<double>(inverted) >= least) out.insert(out.end(), group.begin(), group.end());
  }

  /// With the rings around.
  std::vector<VertexHandle> grow(std::vector<VertexHandle> vertices) {
    forget();
    for (const VertexHandle v : vertices) seen_vertex_[v.index()] = true;
    std::size_t first = 0;
    for (unsigned ring = 0; ring < limits_.rings; ++ring) {
      const std::size_t last = vertices.size();
      for (; first < last; ++first) {
        visit_star(vertices[first], [&](TetHandle t) { take_vertices(t, vertices); });
      }
    }
    return vertices;
  }

  /// Into parts that have no tet in common.
  std::vector<Tangle> divide(const std::vector<VertexHandle>& vertices) {
    std::vector<Tangle> tangles;
    // From now on seen vertices are those that are of no tangle yet.
    seen_tet_.assign(mesh_.tet_slots(), false);
    for (const VertexHandle first : vertices) {
      if (!seen_vertex_[first.index()]) continue;
      Tangle tangle;
      const auto take = [&](VertexHandle v) {
        if (!seen_vertex_[v.index()]) return;
        seen_vertex_[v.index()] = false;
        tangle.free.push_back(v);
      };
      take(first);
      for (std::size_t i = 0; i < tangle.free.size(); ++i) {
        visit_star(tangle.free[i], [&](TetHandle t) {
          if (seen_tet_[t.index()]) return;
          seen_tet_[t.index()] = true;
          tangle.tets.push_back(t);
          for (const VertexHandle v : mesh_.vertices(t)) take(v);
        });
      }
      if (stopped_) return {};
      const auto is_worse = [&](TetHandle x, TetHandle y) {
        return mesh_.quality(x) < mesh_.quality(y);
      };
      tangle.worst = *std::min_element(tangle.tets.begin(), tangle.tets.end(), is_worse);
      tangles.push_back(std::move(tangle));
    }
    return tangles;
  }

  void forget() {
    seen_vertex_.assign(mesh_.vertex_slots(), false);
    seen_tet_.assign(mesh_.tet_slots(), false);
  }

  const TetMesh& mesh_;
  const TangleLimits& limits_;
  const std::function<bool()>& proceed_;
  std::vector<bool> seen_vertex_;
  std::vector<bool> seen_tet_;
  std::size_t stars_ = 0;
  bool stopped_ = false;
};

}  // namespace

std::vector<Tangle> find_tangles(const TetMesh& mesh, const TangleLimits& limits,
                                 const std::function<bool()>& proceed) {
  return TangleFinder(mesh, limits, proceed).find();
}

}  // namespace tetmend
