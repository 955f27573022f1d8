// SPDX-License-Identifier: MIT
// Large neighbourhood search around the worst tets.
//
//   selected tets, the worst first -> neighbourhoods, no tet in two
//   neighbourhood x variant -> copy -> schedule -> outcome        all side by side
//   for each neighbourhood: the best outcome -> one edit -> judge
#include "schedule/vary.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "kernel/error.h"
#include "kernel/judge_limits.h"
#include "kernel/star.h"
#include "kernel/workspace.h"
#include "schedule/neighbourhood.h"
#include "schedule/queue.h"

namespace tetmend {

namespace {

constexpr unsigned kPlain = 4;  // of so many variants one has its vertices where they were
constexpr std::size_t kMostTets = 20000;  // of a neighbourhood: it is to be worked on in seconds

/// What the tets of a neighbourhood are worth, before and in an outcome.
struct Worth {
  std::size_t n_bad = 0;
  std::vector<Quality> worst;  // ascending: the bad ones, or some of the worst

  /// In the order of preference.
  bool is_better_than(const Worth& other) const {
    return n_bad != other.n_bad ? n_bad < other.n_bad : improves(worst, other.worst);
  }
  /// Half of the bad tets are worth a worst one that is worse, down to a share of its quality.
  bool pays_for_worst(const Worth& before, double floor) const {
    return floor < 1 && 2 * n_bad <= before.n_bad && worst.front() >= floor * before.worst.front();
  }
};

struct Outcome {
  Worth worth;
  std::vector<Point> points;
  std::vector<std::uint32_t> origin;  // by point: the vertex of the neighbourhood that stays; none
  std::vector<std::array<std::uint32_t, 4>> tets;

  static constexpr std::uint32_t kNew = std::numeric_limits<std::uint32_t>::max();
};

/// Moves free vertices at random, as far as no tet turns over.
void shake(TetMesh& mesh, std::uint64_t seed) {
  constexpr double kFar = 0.2;  // of the shortest edge
  std::mt19937_64 random(seed);
  const auto coordinate = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  Workspace workspace(mesh);
  std::vector<HalfFace> around;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (mesh.is_deleted(v) || mesh.is_fixed(v)) continue;
    if (find_star(mesh, v, workspace, around) != StarKind::whole) continue;
    double shortest2 = std::numeric_limits<double>::infinity();
    for (const HalfFace f : around) {
      for (const VertexHandle w : mesh.vertices(f)) {
        shortest2 = std::min(shortest2, (mesh.point(w) - mesh.point(v)).squaredNorm());
      }
    }
    // One after another: in a call, the order of the three would be the compiler's.
    Point step;
    for (double& x : step) x = coordinate();
    Transaction transaction(mesh, workspace);
    const Point there = mesh.point(v) + kFar * std::sqrt(shortest2) * step;
    if (transaction.move_vertex(v, there, around) == EditResult::made) transaction.keep();
  }
}

/// Stops the run of a variant when the run of the whole is to stop.
class Stopper final : public ProgressListener {
 public:
  Stopper(Run& whole, Run& variant) : whole_(whole), variant_(variant) {}
  void progress(std::string_view /*phase*/, unsigned /*round*/, double /*share*/) override {
    if (whole_.is_to_stop()) variant_.stop();
  }
  void pass_done(std::string_view /*phase*/, unsigned /*round*/,
                 const QualityIndicators& /*now*/) override {}

 private:
  Run& whole_;
  Run& variant_;
};

class Variants {
 public:
  Variants(Run& run, const VaryOptions& options) : run_(run), options_(options) {}

  /// Around selected tets, the worst first.
  void find(std::vector<QueuedTet> middles) {
    std::sort(middles.begin(), middles.end());
    if (middles.empty()) return;
    // Another turn, other neighbourhoods: of neighbours another one is in the middle.
    const auto first = static_cast<std::ptrdiff_t>(options_.first % middles.size());
    std::rotate(middles.begin(), middles.begin() + first, middles.end());
    for (const QueuedTet& middle : middles) {
      const TetHandle t = middle.tet;
      if (t.index() < marks_.size() && marks_[t.index()] != 0) continue;
      const auto number = static_cast<std::uint32_t>(neighbourhoods_.size() + 1);
      Neighbourhood found = find_neighbourhood(run_.mesh(), run_.worker().workspace(), t,
                                               options_.rings, kMostTets, number, marks_);
      if (found.tets.empty()) continue;
      before_.push_back(worth_of(run_.mesh(), found.tets));
      neighbourhoods_.push_back(std::move(found));
    }
  }
  std::size_t count() const { return neighbourhoods_.size(); }

  void try_all() {
    best_.resize(count());
    const std::size_t tasks = count() * options_.variants;
    std::vector<std::optional<Outcome>> outcomes(tasks);
    std::atomic<std::size_t> done = 0;
    tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
      // A thread that waits for passes of one variant begins no other.
      tbb::this_task_arena::isolate(
          [&] { outcomes[task] = try_one(task / options_.variants, task % options_.variants); });
      run_.report_progress("vary", static_cast<double>(++done) / static_cast<double>(tasks));
    });
    for (std::size_t task = 0; task < tasks; ++task) {
      std::optional<Outcome>& best = best_[task / options_.variants];
      if (!outcomes[task]) continue;
      if (!best || outcomes[task]->worth.is_better_than(best->worth)) {
        best = std::move(outcomes[task]);
      }
    }
  }

  void put_back(std::size_t n) {
    if (run_.cancelled()) return;
    OperatorContext& context = run_.worker().context();
    const Neighbourhood& neighbourhood = neighbourhoods_[n];
    if (context.trace != nullptr) {
      context.trace->attempt_begins({.operator_name = kVariantsName,
                                     .target = run_.mesh().vertices(neighbourhood.tets.front()),
                                     .settings = {}});
    }
    const Verdict verdict = run_.worker().count(attempt(n));
    if (context.trace != nullptr) report_end(context, verdict);
  }

 private:
  std::optional<Outcome> try_one(std::size_t n, std::size_t variant) {
    if (run_.cancelled()) return std::nullopt;
    const auto number = static_cast<std::uint32_t>(options_.first + variant);
    NeighbourhoodCopy copy = copy_neighbourhood(run_.mesh(), neighbourhoods_[n], marks_, number);
    TetMesh mesh(std::move(copy.data));
    if (number % kPlain != 0) shake(mesh, number);
    const Standard standard = run_.mesh().standard();
    // The field lives as long as the mesh that this is a part of.
    mesh.set_size_field({std::shared_ptr<const SizeField>(), run_.mesh().size_field()});
    mesh.set_standard(aim(standard, number));
    mesh.set_bounds(run_.mesh().bounds().under(mesh.standard()));
    Run run(mesh, run_.registry());
    Stopper stopper(run_, run);
    run.set_listener(&stopper);
    improve(run, options_.schedule, options_.settings);
    if (run_.cancelled()) return std::nullopt;
    mesh.set_standard(standard);
    Outcome outcome = describe(mesh, neighbourhoods_[n], copy.vertex);
    const Worth& before = before_[n];
    if (!outcome.worth.is_better_than(before)) return std::nullopt;
    if (!improves(outcome.worth.worst, before.worst) &&
        !outcome.worth.pays_for_worst(before, options_.floor)) {
      return std::nullopt;
    }
    return outcome;
  }

  /// A third of the variants aim at the goal, others at one that is 2 or 4 degrees higher.
  static Standard aim(const Standard& standard, std::uint32_t number) {
    constexpr double kStep = 2;
    const double more = kStep * (number % 3);
    const Goal goal = standard.goal();
    return standard.with_goal(
        {std::min(goal.min_angle + more, 70.0), std::max(goal.max_angle - more, 71.0)});
  }

  Outcome describe(const TetMesh& mesh, const Neighbourhood& neighbourhood,
                   const std::vector<std::uint32_t>& vertex) const {
    Outcome outcome;
    std::vector<std::uint32_t> numbers(mesh.vertex_slots(), 0);
    for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
      const VertexHandle v(i);
      if (mesh.is_deleted(v)) continue;
      numbers[i] = static_cast<std::uint32_t>(outcome.points.size());
      const bool stays = i < vertex.size() && neighbourhood.stays[vertex[i]] != 0;
      outcome.points.push_back(mesh.point(v));
      outcome.origin.push_back(stays ? vertex[i] : Outcome::kNew);
    }
    std::vector<TetHandle> tets;
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      const TetHandle t(i);
      if (mesh.is_deleted(t)) continue;
      tets.push_back(t);
      const TetVertices& v = mesh.vertices(t);
      outcome.tets.push_back({numbers[v[0].index()], numbers[v[1].index()], numbers[v[2].index()],
                              numbers[v[3].index()]});
    }
    outcome.worth = worth_of(mesh, tets);
    return outcome;
  }

  Worth worth_of(const TetMesh& mesh, std::span<const TetHandle> tets) const {
    constexpr std::size_t kWorst = 64;
    Worth worth;
    for (const TetHandle t : tets) {
      worth.worst.push_back(mesh.quality(t));
      worth.n_bad += mesh.quality(t) < kBadThreshold ? 1 : 0;
    }
    std::sort(worth.worst.begin(), worth.worst.end());
    worth.worst.resize(std::min(worth.worst.size(), std::max(worth.n_bad, kWorst)));
    return worth;
  }

  Verdict attempt(std::size_t n) {
    OperatorContext& context = run_.worker().context();
    Comparison& comparison = context.states.comparison;
    comparison.forget();
    if (!best_[n]) return Verdict::no_improvement;
    if (context.trace != nullptr) context.trace->candidate_found();
    const Outcome& outcome = *best_[n];
    const Neighbourhood& neighbourhood = neighbourhoods_[n];
    Transaction transaction(run_.mesh(), run_.worker().workspace());
    std::vector<VertexHandle> handles;
    for (std::size_t i = 0; i < outcome.points.size(); ++i) {
      const bool is_new = outcome.origin[i] == Outcome::kNew;
      handles.push_back(is_new ? transaction.add_vertex(outcome.points[i])
                               : neighbourhood.vertices[outcome.origin[i]]);
      if (!handles.back().is_valid()) return Verdict::deferred;
    }
    std::vector<TetVertices> created;
    created.reserve(outcome.tets.size());
    for (const auto& t : outcome.tets) {
      created.push_back({handles[t[0]], handles[t[1]], handles[t[2]], handles[t[3]]});
    }
    const EditResult result = transaction.replace_cavity(neighbourhood.tets, created);
    if (result != EditResult::made) return to_verdict(result);
    if (!is_worth_it(transaction, before_[n])) return Verdict::no_improvement;
    transaction.keep();
    return Verdict::accepted;
  }

  /// A strict judge may pay for more bad tets; this pass does not.
  bool is_worth_it(const Transaction& transaction, const Worth& before) {
    Comparison& comparison = run_.worker().context().states.comparison;
    const Worth now = worth_of(run_.mesh(), transaction.created());
    if (Judge::strict().accepts({transaction, comparison})) return now.n_bad <= before.n_bad;
    return now.pays_for_worst(before, options_.floor) &&
           Judge::opening(options_.floor).accepts({transaction, comparison}) &&
           keeps_limits(transaction, comparison);
  }

  Run& run_;
  const VaryOptions& options_;
  NeighbourhoodMarks marks_;
  std::vector<Neighbourhood> neighbourhoods_;
  std::vector<Worth> before_;
  std::vector<std::optional<Outcome>> best_;
};

}  // namespace

void vary(Run& run, const VaryOptions& options) {
  PassScope scope(run, "vary");
  run.begin_sweep("vary");
  Variants variants(run, options);
  variants.find(queue_tets(scope, run.mesh(), options.on, 0));
  scope.expect(variants.count());
  variants.try_all();
  for (std::size_t n = 0; n < variants.count(); ++n) variants.put_back(n);
  scope.take_verdicts(run.worker());
  scope.finish();
}

}  // namespace tetmend
