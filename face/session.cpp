// SPDX-License-Identifier: MIT
// A mesh in a solver's loop: built once, moved and mended in turns.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <tetmend/improve.h>

#include "contract/inspector.h"
#include "face/arena.h"
#include "face/array_values.h"
#include "face/bounds_of_run.h"
#include "face/carry.h"
#include "face/constraints.h"
#include "face/maps.h"
#include "face/mesh_access.h"
#include "face/plan.h"
#include "face/regions.h"
#include "face/watcher.h"
#include "kernel/mesh_builder.h"
#include "kernel/mesh_renewal.h"
#include "kernel/mesh_view.h"
#include "kernel/size_field.h"

namespace tetmend {

namespace {

/// What changed before that date was tried in steps before.
constexpr Date kNow = 1;
/// A bad tet is tried again when it is worse by that.
constexpr Quality kWorse = 0.05F;
/// Nobody has tried it yet.
constexpr Quality kUntried = std::numeric_limits<Quality>::infinity();

constexpr std::uint8_t kMostTurns = 255;

constexpr unsigned kRounds = 3;
// Attempts for a bad tet, those around it included.
constexpr double kUsually = 8;
constexpr double kAtMost = 1e4;

Options with_schedule_of_sizes(Options options) {
  const bool is_default = options.script.empty() && options.schedule == Options().schedule;
  if (is_default && options.size_at) options.schedule = "adapt";
  return options;
}

void check_of_session(const Options& options, const face::Plan& plan) {
  const auto refuse = [](std::string_view option, std::string_view reason) {
    throw OptionError(std::string(option), fmt::format("{}: {}", option, reason));
  };
  if (!plan.surface.is_fixed()) refuse("surface", "in a session the program moves the surface");
  if (!options.size.empty()) refuse("size", "a session takes size_at, which follows the points");
  if (!options.trace.empty()) refuse("trace", "a session has none");
  if (options.limit) refuse("limit", "a session proves none");
  if (options.straighten) refuse("straighten", "a session has no tets of second order");
}

/// A step without a schedule: new points are for tets that a round has not cured, so that the mesh
/// does not grow at every step.
void make_rounds(Run& run) {
  const LocalReconnectionOptions quick = {
      .edge_settings = {{"max_level", 2}}, .edge_order = EdgeOrder::angle, .most_edges = 2};
  untangle(run);
  QualityIndicators before = run.indicators();
  for (run.round = 1; run.round <= kRounds && before.n_bad > 0 && !run.cancelled(); ++run.round) {
    local_reconnection(run, run.round == 1 ? quick : LocalReconnectionOptions{});
    smooth(run);
    if (run.cancelled()) return;
    suppress_points(run);
    if (run.round > 1) insert_points(run, {.settings = {{"relax", 1}}});
    smooth(run);
    before = run.indicators();
  }
}

}  // namespace

class Improver::Session {
 public:
  Session(Mesh mesh, Options options)
      : options_(with_schedule_of_sizes(std::move(options))), plan_(options_) {
    check_of_session(options_, plan_);
    face::on_threads(face::threads_of(options_), [&] { build(std::move(mesh)); });
  }

  bool move(std::span<const std::array<double, 3>> points);
  void hold(std::function<bool(std::uint32_t)> must_stay) { must_stay_ = std::move(must_stay); }
  ImproverStep improve(std::size_t attempts);
  const Mesh& mesh() const;
  std::size_t point_count() const { return mesh_.vertex_count(); }
  std::size_t tet_count() const { return mesh_.tet_count(); }

 private:
  void build(Mesh mesh);
  std::size_t mark(std::size_t attempts);
  void hold_vertices();
  void bound();
  MeshData data_at_work() const;
  void run_passes(std::size_t attempts, ImproverStep& step);
  void note_tried(bool all_were);
  void end_step(ImproverStep& step);
  bool is_plain() const {
    return options_.script.empty() && options_.schedule == Options().schedule;
  }

  const Options options_;
  face::Plan plan_;
  std::function<bool(std::uint32_t)> must_stay_;
  TetMesh mesh_;
  std::size_t first_tets_ = 0;
  /// What is known of a tet.
  struct Memory {
    Quality tried = kUntried;  // what it had when it was tried, or became since
    std::uint8_t turns = 0;    // steps that were to try it, and ended too soon

    bool is_worth_a_try(Quality now) const {
      return tried >= kBadThreshold || now <= tried - kWorse;
    }
  };
  std::vector<Memory> memory_;          // by slot
  std::size_t marked_ = 0;              // tets that the step is to try
  double attempts_per_tet_ = kUsually;  // in the steps before
  struct Counts {
    std::size_t points = 0, tets = 0;
  };
  Counts mesh_before_;                   // the step
  bool was_cut_ = false;                 // the step, by its attempts, the clock or the program
  std::optional<MeshData> held_;         // the mesh, where it has more than mesh_ knows
  std::vector<std::string> notes_;       // of the file
  mutable std::unique_ptr<Mesh> shown_;  // for mesh(), until something changes
};

void Improver::Session::build(Mesh mesh) {
  const std::filesystem::path file = mesh.file();
  MeshData data = MeshAccess::take(mesh);
  if (!data.mid_nodes.empty()) {
    throw Error("a session takes tets of first order: the mesh has mid-side nodes");
  }
  face::find_regions(data, options_);
  face::check_conserve(data, options_.conserve);
  notes_ = data.notes;
  if (face::holds_more(data)) held_ = data;
  face::name_constraints(data, !options_.ignore_interior);
  mesh_ = face::build_located(file, data,
                              {.sorted = false,  // the program's numbers are those of the slots
                               .interior = options_.ignore_interior ? InteriorConstraints::dropped
                                                                    : InteriorConstraints::kept});
  mesh_.set_standard(plan_.standard);
  face::protect(mesh_, options_);
  if (options_.keep_size) mesh_.set_size_field(std::make_shared<UsualLengths>(mesh_));
  if (options_.size_at) mesh_.set_size_field(plan_.sizes.field({}, mesh_));
  first_tets_ = mesh_.tet_count();
  memory_.resize(mesh_.tet_slots());
}

bool Improver::Session::move(std::span<const std::array<double, 3>> points) {
  if (points.size() != point_count()) {
    throw Error(fmt::format("move: {} points, the mesh has {}", points.size(), point_count()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [x, y, z] = points[i];
    if (std::isfinite(x) && std::isfinite(y) && std::isfinite(z)) continue;
    throw Error(fmt::format("move: points[{}]: ({}, {}, {}) is not finite", i, x, y, z));
  }
  return face::on_threads(face::threads_of(options_), [&] {
    if (place_points(mesh_, points) > 0) return false;
    shown_.reset();
    for (std::size_t i = 0; held_ && i < points.size(); ++i) {
      held_->points[i] = Point(points[i][0], points[i][1], points[i][2]);
    }
    for (std::uint32_t i = 0; i < memory_.size(); ++i) {
      memory_[i].tried = std::max(memory_[i].tried, mesh_.quality(TetHandle(i)));
    }
    return true;
  });
}

/// Dates the vertices of tets that have got bad, or worse: of so many as there are likely attempts
/// for, those first that had fewer turns, and the worst of these. Returns the number of all.
std::size_t Improver::Session::mark(std::size_t attempts) {
  std::vector<TetHandle> bad;
  mesh_.visit_below(kBadThreshold, 0, mesh_.tet_slots(), [&](TetHandle t) {
    if (memory_[t.index()].is_worth_a_try(mesh_.quality(t))) bad.push_back(t);
  });
  const std::size_t all = bad.size();
  const auto likely = static_cast<double>(attempts) / attempts_per_tet_;
  if (likely < static_cast<double>(all)) {
    std::sort(bad.begin(), bad.end(), [&](TetHandle a, TetHandle b) {
      const auto rank = [&](TetHandle t) {
        return std::tuple(memory_[t.index()].turns, mesh_.quality(t), t.index());
      };
      return rank(a) < rank(b);
    });
    bad.resize(static_cast<std::size_t>(std::ceil(likely)));
  }
  for (const TetHandle t : bad) {
    Memory& memory = memory_[t.index()];
    if (memory.turns < kMostTurns) ++memory.turns;
    for (const VertexHandle v : mesh_.vertices(t)) MeshBuilder::set_changed(mesh_, v, kNow);
  }
  marked_ = bad.size();
  return all;
}

void Improver::Session::hold_vertices() {
  if (!must_stay_) return tetmend::hold(mesh_, {});
  std::vector<char> stays;
  for (std::uint32_t i = 0; i < point_count(); ++i) stays.push_back(must_stay_(i) ? 1 : 0);
  tetmend::hold(mesh_, [&](VertexHandle v) { return stays[mesh_.origin(v)] != 0; });
}

/// Bounds are those of the mesh as the program moved it.
void Improver::Session::bound() {
  mesh_.set_bounds(Bounds());
  if (plan_.sizes.are_wanted()) return;
  std::optional<P1Diagonals> diagonals;
  if (plan_.purpose.keeps_step) diagonals = p1_diagonals(mesh_);
  mesh_.set_bounds(face::bounds_of_run(mesh_, diagonals ? &*diagonals : nullptr).bounds);
}

/// What schedules may select by.
MeshData Improver::Session::data_at_work() const {
  MeshData data;
  if (!held_ || held_->tet_data.empty() || is_plain()) return data;
  data.points = held_->points;
  mesh_.scale().to_work(data.points);
  data.tets = held_->tets;
  data.tet_data = held_->tet_data;
  return data;
}

void Improver::Session::run_passes(std::size_t attempts, ImproverStep& step) {
  face::Watcher watcher(options_);
  Run run(mesh_, plan_.registry);
  if (const auto most = plan_.growth.most(first_tets_)) run.set_most_tets(*most);
  if (!options_.size_at) run.set_first_date(kNow);
  run.set_most_attempts(attempts);
  run.set_listener(&watcher);
  const MeshData data = data_at_work();
  const face::ArrayValues values(data);
  run.set_values(&values);
  contract::Inspector inspector;
  if (options_.check_operators) run.set_inspector(&inspector);
  watcher.watch(&run, step.before);
  watcher.begin(Stage::improving);
  run.set_cancel_flag(options_.cancel);
  if (options_.time_limit > 0) run.set_time_limit(options_.time_limit);
  if (is_plain()) {
    make_rounds(run);
  } else {
    tetmend::improve(run, plan_.schedule, plan_.settings);
  }
  run.set_standard(plan_.standard);
  watcher.watch(nullptr, run.indicators());
  watcher.rethrow();
  step.after = run.indicators();
  for (const PassRecord& record : run.records) {
    step.attempts += record.attempts();
    step.accepted += record.accepted();
  }
  step.notes = std::move(run.notes);
  was_cut_ = run.has_left_off() || run.cancelled();
  step.is_complete = !was_cut_ && marked_ == step.bad_tets;
  if (run.has_left_off()) {
    attempts_per_tet_ = std::min(2 * attempts_per_tet_, kAtMost);
  } else if (marked_ > 0 && !was_cut_) {
    const double now = static_cast<double>(step.attempts) / static_cast<double>(marked_);
    attempts_per_tet_ = (attempts_per_tet_ + std::max(now, 1.0)) / 2;
  }
  if (run.attempts_left() == 0) return;
  step.ending = run.out_of_time() ? Ending::time_limit
                : run.cancelled() ? Ending::cancelled
                                  : Ending::finished;
}

/// What was made or tried, by slots that nobody has collected yet. Where attempts ran out, what was
/// to be tried has had a turn, no more.
void Improver::Session::note_tried(bool all_were) {
  memory_.resize(mesh_.tet_slots());
  for (std::uint32_t i = 0; i < memory_.size(); ++i) {
    const TetHandle t(i);
    if (mesh_.is_deleted(t)) continue;
    if (mesh_.is_created(t)) memory_[i] = {};
    const TetVertices& v = mesh_.vertices(t);
    const bool was_tried =
        std::any_of(v.begin(), v.end(), [&](VertexHandle w) { return mesh_.changed(w) >= kNow; });
    if (all_were && was_tried) memory_[i] = {mesh_.quality(t), 0};
  }
}

/// The mesh is one for the program again; the step says where all went.
void Improver::Session::end_step(ImproverStep& step) {
  const std::size_t old_points = mesh_before_.points;
  const std::size_t old_tets = mesh_before_.tets;
  tetmend::hold(mesh_, {});
  note_tried(!was_cut_);
  std::vector<std::uint32_t> numbers(std::max(old_tets, mesh_.tet_slots()));
  std::iota(numbers.begin(), numbers.end(), 0U);
  step.vertex_map = face::map_vertices(mesh_, old_points);
  step.tet_map = face::map_tets(mesh_, numbers);
  step.tet_map.resize(old_tets);
  std::size_t live = 0;
  for (std::uint32_t i = 0; i < memory_.size(); ++i) {
    const TetHandle t(i);
    if (mesh_.is_deleted(t)) continue;
    if (mesh_.is_touched(t)) ++step.touched_tets;
    memory_[live++] = memory_[i];
  }
  memory_.resize(live);
  if (held_) {
    MeshData now = mesh_.to_data();
    const Scale& scale = mesh_.scale();
    scale.to_work(now.points);
    scale.to_work(held_->points);
    face::carry(*held_, step.vertex_map, step.tet_map, options_.conserve, now);
    scale.to_file(now.points);
    held_ = std::move(now);
  }
  count_as_new(mesh_);
  if (!options_.maps) step.vertex_map = step.tet_map = {};
}

ImproverStep Improver::Session::improve(std::size_t attempts) {
  return face::on_threads(face::threads_of(options_), [&] {
    hold_vertices();
    ImproverStep step;
    mesh_before_ = {point_count(), tet_count()};
    step.before = quality_indicators(mesh_);
    step.bad_tets = mark(attempts);
    bound();
    shown_.reset();
    try {
      run_passes(attempts, step);
    } catch (...) {
      step.is_complete = false;
      was_cut_ = true;
      end_step(step);
      throw;
    }
    end_step(step);
    return step;
  });
}

const Mesh& Improver::Session::mesh() const {
  if (!shown_) {
    MeshData data = held_ ? *held_ : mesh_.to_data();
    data.notes = notes_;
    shown_ = std::make_unique<Mesh>(MeshAccess::make(std::move(data)));
  }
  return *shown_;
}

Improver::Improver(Mesh mesh, Options options)
    : session_(std::make_unique<Session>(std::move(mesh), std::move(options))) {}
Improver::~Improver() = default;
Improver::Improver(Improver&& other) noexcept = default;
Improver& Improver::operator=(Improver&& other) noexcept = default;

bool Improver::move(std::span<const std::array<double, 3>> points) {
  return session_->move(points);
}
void Improver::hold(std::function<bool(std::uint32_t)> must_stay) {
  session_->hold(std::move(must_stay));
}
ImproverStep Improver::improve(std::size_t attempts) {
  return session_->improve(attempts);
}
const Mesh& Improver::mesh() const {
  return session_->mesh();
}
std::size_t Improver::point_count() const {
  return session_->point_count();
}
std::size_t Improver::tet_count() const {
  return session_->tet_count();
}

}  // namespace tetmend
