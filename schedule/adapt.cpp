// SPDX-License-Identifier: MIT
#include "schedule/adapt.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include <tbb/parallel_sort.h>

#include "kernel/error.h"
#include "kernel/star.h"
#include "kernel/wanted_lengths.h"
#include "kernel/workspace.h"
#include "schedule/sweep.h"
#include "search/covering_search.h"

namespace tetmend {

namespace {

/// A split takes one; blocks whose slots do not last wait for the next division.
constexpr double kNewVerticesPerEdge = 2;

/// An edge that misses the range, in the order in which edges are tried.
struct QueuedEdge {
  double rank = 0;  // the lowest first
  std::array<VertexHandle, 2> ends;
  TetEdge edge;  // as one of its tets names it

  std::span<const VertexHandle> corners() const { return ends; }
  bool is_there(const TetMesh& mesh) const {
    return !mesh.is_deleted(ends[0]) && !mesh.is_deleted(ends[1]);
  }
  friend bool operator<(const QueuedEdge& x, const QueuedEdge& y) {
    return x.rank != y.rank ? x.rank < y.rank : x.ends < y.ends;
  }
};

enum class Miss : bool { too_long, too_short };

class EdgeQueue {
 public:
  EdgeQueue(const TetMesh& mesh, const WantedLengths& wanted) : mesh_(mesh) {
    lengths_.resize(mesh.vertex_slots());
    for_chunks(lengths_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const VertexHandle v(static_cast<std::uint32_t>(i));
        if (!mesh.is_deleted(v)) lengths_[i] = wanted.length(mesh.point(v));
      }
    });
  }

  /// Each once, around which something changed at `since` or later.
  std::vector<QueuedEdge> take(PassScope& scope, Miss miss, Date since) const {
    auto edges =
        collect<QueuedEdge>(scope, mesh_.tet_slots(),
                            [&](std::size_t begin, std::size_t end, std::vector<QueuedEdge>& out) {
                              for (std::size_t i = begin; i < end; ++i) {
                                const TetHandle t(static_cast<std::uint32_t>(i));
                                if (!mesh_.is_deleted(t) && !mesh_.is_frozen(t))
                                  take_of(t, miss, since, out);
                              }
                            });
    const PassScope::Scan timed(scope);
    tbb::parallel_sort(edges.begin(), edges.end(), [](const QueuedEdge& x, const QueuedEdge& y) {
      return x.ends != y.ends ? x.ends < y.ends : x.edge < y.edge;
    });
    edges.erase(
        std::unique(edges.begin(), edges.end(),
                    [](const QueuedEdge& x, const QueuedEdge& y) { return x.ends == y.ends; }),
        edges.end());
    return edges;
  }

 private:
  void take_of(TetHandle t, Miss miss, Date since, std::vector<QueuedEdge>& out) const {
    const TetVertices& v = mesh_.vertices(t);
    for (unsigned e = 0; e < kEdgeVertices.size(); ++e) {
      VertexHandle a = v[kEdgeVertices[e][0]];
      VertexHandle b = v[kEdgeVertices[e][1]];
      if (mesh_.changed(a) < since && mesh_.changed(b) < since) continue;
      const double length = WantedLengths::relative_length(
          (mesh_.point(a) - mesh_.point(b)).norm(), lengths_[a.index()], lengths_[b.index()]);
      if (miss == Miss::too_long ? length <= WantedLengths::kMost
                                 : length >= WantedLengths::kLeast) {
        continue;
      }
      if (b < a) std::swap(a, b);
      out.push_back({miss == Miss::too_long ? -length : length, {a, b}, TetEdge(t, e)});
    }
  }

  const TetMesh& mesh_;
  std::vector<double> lengths_;  // wanted, by vertex slot
};

/// As a tet that is there names it; nothing if no tet has it, in the territory.
std::optional<TetEdge> find_edge(Worker& worker, const QueuedEdge& entry) {
  const TetMesh& mesh = worker.mesh();
  if (!mesh.is_deleted(entry.edge.tet())) {
    auto ends = mesh.vertices(entry.edge);
    if (ends[1] < ends[0]) std::swap(ends[0], ends[1]);
    if (ends == entry.ends) return entry.edge;
  }
  return find_in_star(mesh, entry.ends[0], entry.ends[1], worker.workspace());
}

/// The operators of the pass, inside and on a surface that may change.
class LengthAttempts {
 public:
  LengthAttempts(const Registry& registry, Quality floor)
      : judge_(Judge::fits_lengths(floor)),
        split_(registry.make("edge_split", {{"max_degree", double{kMaxSearchRing}}})),
        surface_split_(registry.make("surface_split", {{"relax", 0}})),
        contraction_(registry.make("edge_contraction", {})),
        surface_contraction_(registry.make("surface_contraction", {})) {}

  /// False if the attempt was deferred.
  bool split(Worker& worker, const QueuedEdge& entry) const {
    const JudgedBy judged(worker, judge_);
    const std::optional<TetEdge> edge = find_edge(worker, entry);
    if (!edge) return worker.workspace().territory().is_whole();
    const bool may_be_surface =
        worker.mesh().is_fixed(entry.ends[0]) && worker.mesh().is_fixed(entry.ends[1]);
    const Verdict verdict = worker.attempt(*split_, Target::of(*edge));
    if (verdict != Verdict::constrained || !may_be_surface || !may_surface_change(worker.mesh())) {
      return verdict != Verdict::deferred;
    }
    return worker.attempt(*surface_split_, Target::of(*edge)) != Verdict::deferred;
  }

  bool contract(Worker& worker, const QueuedEdge& entry) const {
    const JudgedBy judged(worker, judge_);
    bool is_deferred = false;
    for (const VertexHandle v : entry.ends) {
      const bool at_surface = worker.mesh().is_fixed(v);
      if (at_surface && !is_worth_a_try(true, worker.mesh(), v)) continue;
      const Verdict verdict =
          worker.attempt(at_surface ? *surface_contraction_ : *contraction_, Target::of(v));
      if (verdict == Verdict::accepted) return true;
      is_deferred = is_deferred || verdict == Verdict::deferred;
    }
    return !is_deferred;
  }

 private:
  static bool may_surface_change(const TetMesh& mesh) { return mesh.surface_guard() != nullptr; }

  Judge judge_;
  std::unique_ptr<Operator> split_, surface_split_, contraction_, surface_contraction_;
};

void sweep(Run& run, PassScope& scope, const LengthAttempts& attempts, Miss miss) {
  const bool splits = miss == Miss::too_long;
  const Date since = run.begin_sweep(splits ? "adapt: split" : "adapt: contract");
  std::vector<QueuedEdge> edges =
      EdgeQueue(run.mesh(), *run.mesh().size_field()->wanted()).take(scope, miss, since);
  work_off(run, scope, std::move(edges), splits ? kNewVerticesPerEdge : 0,
           [&](Worker& worker, const QueuedEdge& entry) {
             return splits ? attempts.split(worker, entry) : attempts.contract(worker, entry);
           });
}

}  // namespace

void adapt(Run& run, const AdaptOptions& options) {
  const SizeField* field = run.mesh().size_field();
  if (field == nullptr || field->wanted() == nullptr) {
    throw Error("adapt: no lengths are wanted: the run has no --size");
  }
  make_pass(run, "adapt", [&](PassScope& scope) {
    const LengthAttempts attempts(run.registry(), static_cast<Quality>(options.floor));
    for (unsigned n = 0; n < options.sweeps && !run.cancelled(); ++n) {
      const std::size_t accepted = scope.accepted();
      run.divide_by_size();
      if (options.split) sweep(run, scope, attempts, Miss::too_long);
      if (options.contract) sweep(run, scope, attempts, Miss::too_short);
      if (scope.accepted() == accepted) return;
    }
  });
}

}  // namespace tetmend
