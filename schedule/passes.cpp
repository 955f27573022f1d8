// SPDX-License-Identifier: MIT
#include "schedule/passes.h"

#include <algorithm>

#include "schedule/queue.h"
#include "schedule/sweep.h"

namespace tetmend {

namespace {

/// For each selected tet on average, in a sweep that inserts.
constexpr double kNewVerticesPerTet = 0.5;

/// Passes that may succeed where another failed have a calendar of their own.
std::string calendar(std::string_view pass, const Composition& what, const Selection& on) {
  return std::string(pass) + ": " + what.describe() + " on " + on.describe();
}

Composition one(const std::string& name, const ParameterSettings& settings,
                EdgeOrder order = EdgeOrder::sine) {
  return {.operator_name = name, .settings = settings, .order = order};
}

/// The attempts of a worker have another judge while this lives.
class JudgedBy {
 public:
  JudgedBy(Worker& worker, const Judge& judge) : context_(worker.context()) {
    context_.judge = &judge;
  }
  ~JudgedBy() { context_.judge = nullptr; }
  JudgedBy(const JudgedBy&) = delete;
  JudgedBy& operator=(const JudgedBy&) = delete;

 private:
  OperatorContext& context_;
};

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
    Selection flipped = all;
    if (options.below < 1) flipped.value = ValueRange{.name = "mean_ratio", .high = options.below};
    const auto smoothing = run.registry().make("mean_smoothing", {});
    const Composition flips = {.kind = Composition::Kind::all_of,
                               .parts = {one("edge_removal", {}), one("multi_face_removal", {})}};
    const TetAttempts attempts(run.registry(), flips);
    const std::string dates = calendar("polish", flips, flipped);
    for (unsigned cycle = 0; cycle < options.cycles && !run.cancelled(); ++cycle) {
      const std::size_t accepted = scope.accepted();
      const Judge judge =
          Judge::raises_mean(summarize(run.mesh(), find_quality_measure("mean_ratio")).mean);
      const Date since = run.begin_sweep(dates);
      work_off(run, scope, queue_vertices(scope, run.mesh(), all, since), 0,
               [&](Worker& worker, QueuedVertex entry) {
                 const JudgedBy judged(worker, judge);
                 return worker.attempt(*smoothing, Target::of(entry.vertex)) != Verdict::deferred;
               });
      work_off(run, scope, queue_tets(scope, run.mesh(), flipped, since), 0,
               [&](Worker& worker, QueuedTet& entry) {
                 const JudgedBy judged(worker, judge);
                 return attempts.work_off(worker, entry, since);
               });
      if (scope.accepted() == accepted) return;
    }
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
