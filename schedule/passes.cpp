// SPDX-License-Identifier: MIT
#include "schedule/passes.h"

#include <algorithm>

#include "kernel/size_field.h"
#include "kernel/workspace.h"
#include "schedule/queue.h"
#include "schedule/sweep.h"

namespace tetmend {

namespace {

/// For each selected tet on average, in a sweep that inserts.
constexpr double kNewVerticesPerTet = 0.5;

constexpr double kMostAroundEdge = 5;  // more become so many that their mean hardly rises

/// Passes that may succeed where another failed have a calendar of their own. How many tets one takes
/// is nothing that makes it succeed.
std::string calendar(std::string_view pass, const Composition& what, Selection on) {
  on.worst = Selection{}.worst;
  on.at_least = 0;
  on.share = 1;
  return std::string(pass) + ": " + what.describe() + " on " + on.describe();
}

Composition one(const std::string& name, const ParameterSettings& settings,
                EdgeOrder order = EdgeOrder::sine) {
  return {.operator_name = name, .settings = settings, .order = order};
}

/// False when there was nothing to try.
bool sweep_tets(Run& run, PassScope& scope, const TetAttempts& attempts, const Selection& on,
                Date since, double new_vertices) {
  auto tets = queue_tets(scope, run.mesh(), on, since);
  if (tets.empty()) return false;
  work_off(run, scope, std::move(tets), new_vertices, [&](Worker& worker, QueuedTet& entry) {
    return attempts.work_off(worker, entry, since);
  });
  return true;
}

void sweep_vertices(Run& run, PassScope& scope, const Operator& op, const Selection& on,
                    Date since) {
  work_off(run, scope, queue_vertices(scope, run.mesh(), on, since, op.info().at_surface), 0,
           [&](Worker& worker, QueuedVertex entry) {
             return worker.attempt(op, Target::of(entry.vertex)) != Verdict::deferred;
           });
}

/// Fewer tets after a cycle of polish would not raise the share of bad angles beyond that many percent.
bool has_share_left(const TetMesh& mesh, double lambda) {
  constexpr double kLeftByCycle = 0.95;  // of the tets
  if (lambda >= 100) return true;
  const double now = compute_statistics(mesh, mesh.standard().goal()).lambda;
  return now == 0 || now <= kLeftByCycle * lambda;
}

/// Vertices with an edge that is shorter than a share of the local length at both its ends.
std::vector<QueuedVertex> queue_close(PassScope& scope, const TetMesh& mesh, double share,
                                      Date since) {
  const std::vector<double> lengths = local_lengths(mesh);
  const auto is_close = [&](VertexHandle a, VertexHandle b) {
    const double usual = (lengths[a.index()] + lengths[b.index()]) / 2;
    return (mesh.point(a) - mesh.point(b)).squaredNorm() < share * share * usual * usual;
  };
  std::vector<QueuedVertex> all = collect<QueuedVertex>(
      scope, mesh.tet_slots(),
      [&](std::size_t begin, std::size_t end, std::vector<QueuedVertex>& out) {
        for (std::size_t i = begin; i < end; ++i) {
          const TetHandle t(static_cast<std::uint32_t>(i));
          if (mesh.is_deleted(t)) continue;
          const TetVertices& v = mesh.vertices(t);
          for (const auto& [j, k] : kEdgeVertices) {
            if (!is_close(v[j], v[k])) continue;
            for (const VertexHandle w : {v[j], v[k]}) {
              if (!mesh.is_fixed(w) && mesh.changed(w) >= since) out.push_back({w});
            }
          }
        }
      });
  keep_each_once(scope, mesh, all);
  return all;
}

}  // namespace

void local_reconnection(Run& run, const LocalReconnectionOptions& options) {
  make_pass(run, "local_reconnection", [&](PassScope& scope) {
    Composition what{.kind = Composition::Kind::all_of};
    if (!options.edge_operator.empty()) {
      what.parts.push_back(one(options.edge_operator, options.edge_settings, options.edge_order));
      what.parts.back().most_edges = options.most_edges;
    }
    if (!options.face_operator.empty()) {
      what.parts.push_back(one(options.face_operator, options.face_settings));
    }
    const TetAttempts attempts(run.registry(), what);
    const std::string dates = calendar("local_reconnection", what, options.on);
    for (unsigned sweep = 0; sweep < options.sweeps && !run.cancelled(); ++sweep) {
      if (!sweep_tets(run, scope, attempts, options.on, run.begin_sweep(dates), 0)) return;
    }
  });
}

void smooth(Run& run, const SmoothOptions& options) {
  make_pass(run, "smooth", [&](PassScope& scope) {
    const auto smoothing = run.registry().make("smoothing", options.settings);
    const std::string dates = calendar("smooth", one("smoothing", options.settings), options.on);
    QualityIndicators before = scope.indicators();
    for (unsigned cycle = 0; cycle < options.cycles && !run.cancelled(); ++cycle) {
      sweep_vertices(run, scope, *smoothing, options.on, run.begin_sweep(dates));
      const QualityIndicators now = scope.indicators();
      if (!is_progress(before, now)) return;
      before = now;
    }
  });
}

void suppress_points(Run& run, const SuppressPointsOptions& options) {
  make_pass(run, "suppress_points", [&](PassScope& scope) {
    const auto contraction = run.registry().make("edge_contraction", options.settings);
    const Date since = run.begin_sweep(
        calendar("suppress_points", one("edge_contraction", options.settings), options.on));
    sweep_vertices(run, scope, *contraction, options.on, since);
  });
}

void insert_points(Run& run, const InsertPointsOptions& options) {
  make_pass(run, "insert_points", [&](PassScope& scope) {
    const Composition what = one("edge_split", options.settings, EdgeOrder::longest);
    const TetAttempts attempts(run.registry(), what);
    const Date since = run.begin_sweep(calendar("insert_points", what, options.on));
    sweep_tets(run, scope, attempts, options.on, since, kNewVerticesPerTet);
  });
}

void apply(Run& run, const ApplyOptions& options) {
  make_pass(run, options.what.name(), [&](PassScope& scope) {
    const TetAttempts attempts(run.registry(), options.what);
    const bool by_vertex =
        options.what.kind == Composition::Kind::one &&
        run.registry().find(options.what.operator_name).target == TargetKind::vertex;
    const auto op = by_vertex
                        ? run.registry().make(options.what.operator_name, options.what.settings)
                        : nullptr;
    const std::string dates = calendar("apply", options.what, options.on);
    for (unsigned sweep = 0; sweep < options.sweeps && !run.cancelled(); ++sweep) {
      const std::size_t accepted = scope.accepted();
      const Date last = run.begin_sweep(dates);
      const Date since = options.again && sweep == 0 ? 0 : last;
      if (by_vertex) {
        sweep_vertices(run, scope, *op, options.on, since);
      } else {
        sweep_tets(run, scope, attempts, options.on, since, kNewVerticesPerTet);
      }
      if (scope.accepted() == accepted) return;
    }
  });
}

void polish(Run& run, const PolishOptions& options) {
  make_pass(run, "polish", [&](PassScope& scope) {
    const Selection all = {.below = Selection::kAll};
    const auto poor = [&](double below) {
      Selection some = all;
      if (below < 1) some.value = ValueRange{.name = "mean_ratio", .high = below};
      return some;
    };
    const Selection flipped = poor(options.below);
    const auto smoothing = run.registry().make("mean_smoothing", {});
    const auto contraction = run.registry().make("edge_contraction", {});
    const Composition flips = {.kind = Composition::Kind::all_of,
                               .parts = {one("edge_removal", {{"max_degree", kMostAroundEdge}}),
                                         one("multi_face_removal", {})}};
    const TetAttempts flipping(run.registry(), flips);
    const TetAttempts inserting(run.registry(), one("centroid_insertion", {}));
    const std::string dates = calendar("polish", flips, flipped);
    const std::size_t allowed = run.worker().workspace().most_tets();
    const double most = (1 + options.grow) * static_cast<double>(run.mesh().tet_count());
    run.set_most_tets(std::min(allowed, static_cast<std::size_t>(most)));
    for (unsigned cycle = 0; cycle < options.cycles && !run.cancelled(); ++cycle) {
      const std::size_t accepted = scope.accepted();
      const Judge judge =
          Judge::raises_mean(summarize(run.mesh(), find_quality_measure("mean_ratio")).mean);
      const Date since = run.begin_sweep(dates);
      const auto try_vertices = [&](const Operator& op, std::vector<QueuedVertex> vertices) {
        work_off(run, scope, std::move(vertices), 0, [&](Worker& worker, QueuedVertex entry) {
          const JudgedBy judged(worker, judge);
          return worker.attempt(op, Target::of(entry.vertex)) != Verdict::deferred;
        });
      };
      const auto try_tets = [&](const TetAttempts& attempts, const Selection& on,
                                double new_vertices) {
        work_off(run, scope, queue_tets(scope, run.mesh(), on, since), new_vertices,
                 [&](Worker& worker, QueuedTet& entry) {
                   const JudgedBy judged(worker, judge);
                   return attempts.work_off(worker, entry, since);
                 });
      };
      try_vertices(*smoothing, queue_vertices(scope, run.mesh(), poor(options.smooth), since));
      const bool may_shrink = has_share_left(run.mesh(), options.lambda);
      if (may_shrink) try_tets(flipping, flipped, 0);
      if (options.contract > 0 && may_shrink) {
        try_vertices(*contraction, queue_close(scope, run.mesh(), options.contract, since));
      }
      if (options.insert > 0) try_tets(inserting, poor(options.insert), kNewVerticesPerTet);
      if (scope.accepted() == accepted) break;
    }
    run.set_most_tets(allowed);
  });
}

bool is_progress(const QualityIndicators& before, const QualityIndicators& now) {
  constexpr double kQualityStep = 1e-2;
  const double bad_step = std::max(1.0, 0.05 * static_cast<double>(before.n_bad));
  if (now.q_worst > before.q_worst + kQualityStep) return true;
  if (static_cast<double>(now.n_bad) <= static_cast<double>(before.n_bad) - bad_step) return true;
  return now.n_bad <= before.n_bad && now.n_bad > 0 && now.q_aver > before.q_aver + kQualityStep;
}

}  // namespace tetmend
