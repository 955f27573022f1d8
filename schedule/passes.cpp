// SPDX-License-Identifier: MIT
#include "schedule/passes.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace tetmend {

namespace {

/// A tet as it was when it was queued. Slots are re-used, so the vertices tell whether it is still
/// there.
struct QueuedTet {
  Quality quality;
  TetHandle tet;
  TetVertices vertices;
};

bool is_there(const TetMesh& mesh, const QueuedTet& entry) {
  return entry.tet.index() < mesh.tet_slots() && mesh.vertices(entry.tet) == entry.vertices;
}

/// Something near the tet changed at `since` or later.
bool changed_since(const TetMesh& mesh, const TetVertices& vertices, Date since) {
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](VertexHandle v) { return mesh.changed(v) >= since; });
}

/// Bad tets, worst first; equal ones in slot order.
std::vector<QueuedTet> queue_bad_tets(const TetMesh& mesh, Quality threshold, Date since) {
  std::vector<QueuedTet> queue;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t) || mesh.quality(t) >= threshold) continue;
    if (!changed_since(mesh, mesh.vertices(t), since)) continue;
    queue.push_back({mesh.quality(t), t, mesh.vertices(t)});
  }
  std::sort(queue.begin(), queue.end(), [](const QueuedTet& a, const QueuedTet& b) {
    return a.quality != b.quality ? a.quality < b.quality : a.tet < b.tet;
  });
  return queue;
}

/// Movable vertices of bad tets around which something changed, in slot order.
std::vector<VertexHandle> list_bad_points(const TetMesh& mesh, Quality threshold, Date since) {
  std::vector<bool> seen(mesh.vertex_slots(), false);
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t) || mesh.quality(t) >= threshold) continue;
    for (const VertexHandle v : mesh.vertices(t)) {
      if (!mesh.is_fixed(v) && mesh.changed(v) >= since) seen[v.index()] = true;
    }
  }
  std::vector<VertexHandle> points;
  for (std::uint32_t i = 0; i < seen.size(); ++i) {
    if (seen[i]) points.push_back(VertexHandle(i));
  }
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
  Reconnection(Run& run, const LocalReconnection& options, PassScope& scope)
      : mesh_(run.mesh()), scope_(scope) {
    if (!options.edge_operator.empty()) {
      edges_ = run.registry().make(options.edge_operator, options.edge_settings);
    }
    if (!options.face_operator.empty()) {
      faces_ = run.registry().make(options.face_operator, options.face_settings);
    }
  }

  void remove(const QueuedTet& entry) {
    if (edges_) {
      for (const unsigned e : edges_by_sine(mesh_, entry.vertices)) {
        scope_.attempt(*edges_, Target::of(TetEdge(entry.tet, e)));
        if (!is_there(mesh_, entry)) return;
      }
    }
    if (faces_) {
      for (unsigned f = 0; f < 4; ++f) {
        scope_.attempt(*faces_, Target::of(HalfFace(entry.tet, f)));
        if (!is_there(mesh_, entry)) return;
      }
    }
  }

 private:
  const TetMesh& mesh_;
  PassScope& scope_;
  std::unique_ptr<Operator> edges_;
  std::unique_ptr<Operator> faces_;
};

}  // namespace

void local_reconnection(Run& run, const LocalReconnection& options) {
  PassScope scope(run, "local_reconnection");
  Reconnection reconnection(run, options, scope);
  for (unsigned sweep = 0; sweep < options.sweeps; ++sweep) {
    const auto queue =
        queue_bad_tets(run.mesh(), options.threshold, run.begin_sweep(options.calendar));
    if (queue.empty()) return;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      if (!scope.proceed(i, queue.size())) return;
      if (is_there(run.mesh(), queue[i])) reconnection.remove(queue[i]);
    }
  }
}

void smooth(Run& run, const SmoothingPass& options) {
  PassScope scope(run, "smoothing");
  const auto smoothing = run.registry().make("smoothing", options.settings);
  QualityIndicators before = quality_indicators(run.mesh());
  for (unsigned cycle = 0; cycle < options.cycles; ++cycle) {
    const auto points =
        list_bad_points(run.mesh(), options.threshold, run.begin_sweep(options.calendar));
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!scope.proceed(i, points.size())) return;
      scope.attempt(*smoothing, Target::of(points[i]));
    }
    const QualityIndicators now = quality_indicators(run.mesh());
    if (!is_progress(before, now)) return;
    before = now;
  }
}

void suppress_points(Run& run, const SuppressionPass& options) {
  PassScope scope(run, "point_suppression");
  const auto contraction = run.registry().make("edge_contraction", options.settings);
  const auto points =
      list_bad_points(run.mesh(), options.threshold, run.begin_sweep(options.calendar));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!scope.proceed(i, points.size())) return;
    scope.attempt(*contraction, Target::of(points[i]));
  }
}

void insert_points(Run& run, const InsertionPass& options) {
  PassScope scope(run, "point_insertion");
  const TetMesh& mesh = run.mesh();
  const auto split = run.registry().make("edge_split", options.settings);
  auto queue = queue_bad_tets(mesh, options.threshold, run.begin_sweep(options.calendar));
  const auto most = static_cast<std::size_t>(options.share * static_cast<double>(mesh.tet_count()));
  if (queue.size() > std::max(most, kFewTets)) queue.resize(std::max(most, kFewTets));
  std::unordered_set<std::uint64_t> tried;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    if (!scope.proceed(i, queue.size())) return;
    const QueuedTet& entry = queue[i];
    if (!is_there(mesh, entry)) continue;
    const auto longest_first = sorted_edges([&](unsigned e) {
      const auto& [v, w] = kEdgeVertices[e];
      return -(mesh.point(entry.vertices[v]) - mesh.point(entry.vertices[w])).squaredNorm();
    });
    for (const unsigned e : longest_first) {
      const auto [v, w] = mesh.vertices(TetEdge(entry.tet, e));
      const std::uint64_t low = std::min(v, w).index();
      if (!tried.insert(low << 32 | std::max(v, w).index()).second) continue;
      scope.attempt(*split, Target::of(TetEdge(entry.tet, e)));
      if (!is_there(mesh, entry)) break;
    }
  }
}

bool is_progress(const QualityIndicators& before, const QualityIndicators& now) {
  constexpr double kQualityStep = 1e-3;
  const double bad_step = std::max(1.0, 0.03 * static_cast<double>(before.n_bad));
  if (now.q_worst > before.q_worst + kQualityStep) return true;
  if (static_cast<double>(now.n_bad) <= static_cast<double>(before.n_bad) - bad_step) return true;
  return now.n_bad <= before.n_bad && now.n_bad > 0 && now.q_aver > before.q_aver + kQualityStep;
}

}  // namespace tetmend
