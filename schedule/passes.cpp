// SPDX-License-Identifier: MIT
#include "schedule/passes.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_sort.h>

#include "schedule/sweep.h"

namespace tetmend {

namespace {

/// A tet as it was when it was queued, worst first. Slots are re-used, so the vertices tell whether
/// it is still there.
struct BadTet {
  Quality quality = 0;
  TetHandle tet;
  TetVertices vertices;
  std::uint16_t todo = 0x3FF;  // bits 0-5: edges, 6-9: faces

  std::span<const VertexHandle> corners() const { return vertices; }
  bool is_there(const TetMesh& mesh) const { return mesh.vertices(tet) == vertices; }
  friend bool operator<(const BadTet& x, const BadTet& y) {
    return x.quality != y.quality ? x.quality < y.quality : x.tet < y.tet;
  }
};

/// A movable vertex of a bad tet, in slot order.
struct BadPoint {
  VertexHandle vertex;

  std::span<const VertexHandle> corners() const { return {&vertex, 1}; }
  bool is_there(const TetMesh& mesh) const { return !mesh.is_deleted(vertex); }
  friend bool operator<(BadPoint x, BadPoint y) { return x.vertex < y.vertex; }
  friend bool operator==(BadPoint x, BadPoint y) { return x.vertex == y.vertex; }
};

/// Something near the tet changed at `since` or later.
bool changed_since(const TetMesh& mesh, const TetVertices& vertices, Date since) {
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](VertexHandle v) { return mesh.changed(v) >= since; });
}

/// A tet around all of the vertices changed at `since` or later: what changed has them all as
/// vertices, or one of them moved.
template <std::size_t N>
bool changed_around(const TetMesh& mesh, const std::array<VertexHandle, N>& vertices, Date since) {
  bool all = true;
  for (const VertexHandle v : vertices) {
    if (mesh.moved(v) >= since) return true;
    all = all && mesh.changed(v) >= since;
  }
  return all;
}

/// The worst of the bad tets.
std::vector<BadTet> collect_bad_tets(PassScope& scope, const TetMesh& mesh, Quality threshold,
                                     Worst worst, Date since) {
  auto tets = collect<BadTet>(scope, mesh.tet_slots(),
                              [&](std::size_t begin, std::size_t end, std::vector<BadTet>& out) {
                                mesh.visit_below(threshold, begin, end, [&](TetHandle t) {
                                  if (changed_since(mesh, mesh.vertices(t), since)) {
                                    out.push_back({mesh.quality(t), t, mesh.vertices(t)});
                                  }
                                });
                              });
  if (worst.below >= threshold || tets.size() <= worst.at_least) return tets;
  const auto least = tets.begin() + static_cast<std::ptrdiff_t>(worst.at_least);
  std::nth_element(tets.begin(), least, tets.end());
  tets.erase(std::remove_if(least, tets.end(),
                            [&](const BadTet& tet) { return tet.quality >= worst.below; }),
             tets.end());
  return tets;
}

/// Movable vertices of bad tets around which something changed, in slot order.
std::vector<BadPoint> collect_bad_points(PassScope& scope, const TetMesh& mesh, Quality threshold,
                                         Date since) {
  auto points = collect<BadPoint>(
      scope, mesh.tet_slots(), [&](std::size_t begin, std::size_t end, std::vector<BadPoint>& out) {
        mesh.visit_below(threshold, begin, end, [&](TetHandle t) {
          for (const VertexHandle v : mesh.vertices(t)) {
            if (!mesh.is_fixed(v) && mesh.changed(v) >= since) out.push_back({v});
          }
        });
      });
  const PassScope::Scan timed(scope);
  tbb::parallel_sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// The edges of a tet by rank, lowest first; equal ranks in edge order.
template <class Rank>
std::array<unsigned, 6> sorted_edges(Rank&& rank) {
  std::array<double, 6> ranks{};
  for (unsigned e = 0; e < 6; ++e) ranks[e] = rank(e);
  std::array<unsigned, 6> edges = {0, 1, 2, 3, 4, 5};
  std::sort(edges.begin(), edges.end(), [&](unsigned x, unsigned y) {
    return ranks[x] != ranks[y] ? ranks[x] < ranks[y] : x < y;
  });
  return edges;
}

/// Sine of the dihedral angle at each edge, up to a common factor, squared.
std::array<unsigned, 6> edges_by_sine(const TetMesh& mesh, const TetVertices& tv) {
  std::array<double, 4> normal2{};
  for (unsigned f = 0; f < 4; ++f) {
    const auto& local = kFaceVertices[f];
    const Point& p = mesh.point(tv[local[0]]);
    normal2[f] = (mesh.point(tv[local[1]]) - p).cross(mesh.point(tv[local[2]]) - p).squaredNorm();
  }
  return sorted_edges([&](unsigned e) {
    const auto& [i, j] = kEdgeVertices[e];
    return (mesh.point(tv[i]) - mesh.point(tv[j])).squaredNorm() * normal2[i] * normal2[j];
  });
}

class Reconnection {
 public:
  Reconnection(const Registry& registry, const LocalReconnection& options) {
    if (!options.edge_operator.empty()) {
      edges_ = registry.make(options.edge_operator, options.edge_settings);
    }
    if (!options.face_operator.empty()) {
      faces_ = registry.make(options.face_operator, options.face_settings);
    }
  }

  /// Tries edges and faces whose neighbourhood changed at `since` or later until the tet is gone.
  /// False if some were deferred; these are noted in the entry.
  bool remove(Worker& worker, BadTet& entry, Date since) const {
    const TetMesh& mesh = worker.mesh();
    std::uint16_t deferred = 0;
    if (edges_) {
      for (const unsigned e : edges_by_sine(mesh, entry.vertices)) {
        const TetEdge edge(entry.tet, e);
        if ((entry.todo >> e & 1u) == 0 || !changed_around(mesh, mesh.vertices(edge), since))
          continue;
        const auto [a, b] = mesh.vertices(edge);
        if (worker.tried_edges.contains(a.index(), b.index())) continue;
        const Verdict verdict = worker.attempt(*edges_, Target::of(edge));
        if (!entry.is_there(mesh)) return true;
        if (verdict == Verdict::deferred) deferred |= static_cast<std::uint16_t>(1u << e);
        if (verdict != Verdict::accepted) worker.tried_edges.insert(a.index(), b.index());
      }
    }
    if (faces_) {
      for (unsigned f = 0; f < 4; ++f) {
        const HalfFace face(entry.tet, f);
        if ((entry.todo >> (6 + f) & 1u) == 0 || mesh.is_boundary(face) ||
            !changed_around(mesh, mesh.vertices(face), since))
          continue;
        const HalfFace twin = mesh.twin(face);
        const VertexHandle a = entry.vertices[f];
        const VertexHandle b = mesh.vertices(twin.tet())[twin.face()];
        // All faces between two vertices are tried together.
        if (worker.tried_faces.contains(a.index(), b.index())) continue;
        const Verdict verdict = worker.attempt(*faces_, Target::of(face));
        if (!entry.is_there(mesh)) return true;
        if (verdict == Verdict::deferred) deferred |= static_cast<std::uint16_t>(64u << f);
        if (verdict != Verdict::accepted) worker.tried_faces.insert(a.index(), b.index());
      }
    }
    entry.todo = deferred;
    return deferred == 0;
  }

 private:
  std::unique_ptr<Operator> edges_;
  std::unique_ptr<Operator> faces_;
};

}  // namespace

void local_reconnection(Run& run, const LocalReconnection& options) {
  PassScope scope(run, "local_reconnection");
  const Reconnection reconnection(run.registry(), options);
  for (unsigned sweep = 0; sweep < options.sweeps && !run.cancelled(); ++sweep) {
    const Date since = run.begin_sweep(options.calendar);
    auto tets = collect_bad_tets(scope, run.mesh(), options.threshold, options.worst, since);
    if (tets.empty()) return;
    work_off(run, scope, std::move(tets), 0, [&](Worker& worker, BadTet& entry) {
      return reconnection.remove(worker, entry, since);
    });
  }
}

void smooth(Run& run, const SmoothingPass& options) {
  PassScope scope(run, "smoothing");
  const auto smoothing = run.registry().make("smoothing", options.settings);
  QualityIndicators before = scope.indicators();
  for (unsigned cycle = 0; cycle < options.cycles && !run.cancelled(); ++cycle) {
    const Date since = run.begin_sweep(options.calendar);
    work_off(run, scope, collect_bad_points(scope, run.mesh(), options.threshold, since), 0,
             [&](Worker& worker, BadPoint point) {
               return worker.attempt(*smoothing, Target::of(point.vertex)) != Verdict::deferred;
             });
    const QualityIndicators now = scope.indicators();
    if (!is_progress(before, now)) return;
    before = now;
  }
}

void suppress_points(Run& run, const SuppressionPass& options) {
  PassScope scope(run, "point_suppression");
  const auto contraction = run.registry().make("edge_contraction", options.settings);
  const Date since = run.begin_sweep(options.calendar);
  work_off(run, scope, collect_bad_points(scope, run.mesh(), options.threshold, since), 0,
           [&](Worker& worker, BadPoint point) {
             return worker.attempt(*contraction, Target::of(point.vertex)) != Verdict::deferred;
           });
}

void insert_points(Run& run, const InsertionPass& options) {
  PassScope scope(run, "point_insertion");
  const TetMesh& mesh = run.mesh();
  const auto split = run.registry().make("edge_split", options.settings);
  const Date since = run.begin_sweep(options.calendar);
  auto tets = collect_bad_tets(scope, mesh, options.threshold, options.worst, since);
  const auto try_tet = [&](Worker& worker, BadTet& entry) {
    const auto longest_first = sorted_edges([&](unsigned e) {
      const auto& [v, w] = kEdgeVertices[e];
      return -(mesh.point(entry.vertices[v]) - mesh.point(entry.vertices[w])).squaredNorm();
    });
    std::uint16_t deferred = 0;
    for (const unsigned e : longest_first) {
      const TetEdge edge(entry.tet, e);
      if ((entry.todo >> e & 1u) == 0 || !changed_around(mesh, mesh.vertices(edge), since))
        continue;
      const auto [v, w] = mesh.vertices(edge);
      if (!worker.tried_edges.insert(v.index(), w.index())) continue;
      const Verdict verdict = worker.attempt(*split, Target::of(edge));
      if (!entry.is_there(mesh)) return true;
      if (verdict == Verdict::deferred) deferred |= static_cast<std::uint16_t>(1u << e);
    }
    entry.todo = deferred;
    return deferred == 0;
  };
  constexpr double kNewVerticesPerTet = 0.5;
  work_off(run, scope, std::move(tets), kNewVerticesPerTet, try_tet);
}

bool is_progress(const QualityIndicators& before, const QualityIndicators& now) {
  constexpr double kQualityStep = 5e-3;
  const double bad_step = std::max(1.0, 0.05 * static_cast<double>(before.n_bad));
  if (now.q_worst > before.q_worst + kQualityStep) return true;
  if (static_cast<double>(now.n_bad) <= static_cast<double>(before.n_bad) - bad_step) return true;
  return now.n_bad <= before.n_bad && now.n_bad > 0 && now.q_aver > before.q_aver + kQualityStep;
}

}  // namespace tetmend
