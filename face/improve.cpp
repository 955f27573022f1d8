// SPDX-License-Identifier: MIT
// The one verb.
//
//   look at the options | build | measure | run the schedule | measure | compare | plain arrays again
//
// The plain arrays are taken apart on the way in, and the mesh on the way out: neither is in memory
// twice.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/improve.h>

#include "contract/inspector.h"
#include "face/advice.h"
#include "face/arena.h"
#include "face/array_values.h"
#include "face/bounds_of_run.h"
#include "face/carry.h"
#include "face/constraints.h"
#include "face/curving.h"
#include "face/growth.h"
#include "face/maps.h"
#include "face/mesh_access.h"
#include "face/mid_nodes.h"
#include "face/plan.h"
#include "face/recorded.h"
#include "face/regions.h"
#include "face/size_statistics.h"
#include "face/surface_points.h"
#include "face/trace_plan.h"
#include "face/watcher.h"
#include "face/worse.h"
#include "kernel/bounds.h"
#include "kernel/chunks.h"
#include "kernel/curved.h"
#include "kernel/formats/deck_remarks.h"
#include "kernel/integrity.h"
#include "kernel/rulers.h"
#include "kernel/size_field.h"
#include "kernel/solver_rulers.h"
#include "kernel/stopwatch.h"
#include "kernel/surface_fingerprint.h"
#include "kernel/volume_rounding.h"
#include "platform/platform.h"
#include "schedule/limit/surface_limit.h"

namespace tetmend {

namespace {

Pass to_pass(PassRecord&& record) {
  Pass pass;
  pass.name = std::move(record.name);
  pass.round = record.round;
  pass.seconds = record.seconds;
  pass.verdicts = record.verdicts;
  pass.items = record.items;
  pass.deferred = record.deferred;
  pass.seconds_in_scans = record.seconds_in_scans;
  pass.seconds_in_blocks = record.seconds_in_blocks;
  pass.after = record.after;
  return pass;
}

std::size_t count_touched(const TetMesh& mesh) {
  return count_in_chunks(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const TetHandle t(static_cast<std::uint32_t>(i));
      if (!mesh.is_deleted(t) && mesh.is_touched(t)) ++count;
    }
    return count;
  });
}

/// One call of improve().
class Improvement {
 public:
  Improvement(Mesh& mesh, const Options& options, face::Plan& plan, face::Portrait* portrait,
              face::Follower* follower, face::Figures figures = face::Figures::all)
      : user_mesh_(mesh),
        options_(options),
        plan_(plan),
        figures_(figures),
        portrait_(portrait),
        follower_(follower),
        watcher_(options),
        file_(mesh.file()) {}

  /// Without its trace.
  Result run() {
    result_.goal = options_.goal;
    build();
    try {
      measure_before();
      run_schedule(kAllPasses, options_.time_limit);
      measure_after();
      if (gives_for_mending()) mend_within_bounds();
      if (!face::worse_for_nothing(result_).empty()) go_back();
      note(face::advice_after(mesh_, input_, options_, result_));
      map_entities();
    } catch (const contract::Breach& breach) {
      give_back_input();
      throw Error(breach.what());
    } catch (...) {
      give_back();
      throw;
    }
    check_promises();
    give_back();
    if (!options_.maps) result_.vertex_map = result_.tet_map = {};
    watcher_.rethrow();
    if (!options_.rulers) result_.rulers_before = result_.rulers_after = std::nullopt;
    return std::move(result_);
  }
  /// After run(). Null: nothing was recorded.
  std::unique_ptr<TraceRecorder> take_trace() { return std::move(trace_); }

 private:
  static constexpr std::size_t kAllPasses = std::numeric_limits<std::size_t>::max();
  /// What mending an inverted tet may do to the bounds of the input.
  enum class Mending : bool { breaks_bounds, keeps_bounds };

  void build();
  void build_mesh(MeshData& data, Mending mending = Mending::breaks_bounds);
  void hold_curved();
  void measure_before();
  ScheduleSettings for_surface() const;
  void run_schedule(std::size_t passes, double seconds);
  void measure_after();
  CgSteps cg_steps() const {
    return figures_ == face::Figures::all ? CgSteps::estimated : CgSteps::left_out;
  }
  bool gives_for_mending() const {
    return result_.worse().size() > face::worse_for_nothing(result_).size();
  }
  /// What a run has made, while another one is tried.
  struct Made {
    TetMesh mesh;
    std::unique_ptr<TraceRecorder> trace;
    Result result;
  };
  void mend_within_bounds();
  Made put_aside();
  void put_back(Made made);
  void make_again(Mending mending, double seconds);
  void go_back();
  bool is_stopped() const {
    return watcher_.stopped() || (options_.cancel != nullptr && options_.cancel->load());
  }
  std::size_t best_pass() const;
  void map_entities();
  void give_back();
  void give_back_improved();
  MeshData data_so_far() const;
  std::vector<std::uint32_t> frozen_tets() const;
  void curve_inside(const std::vector<std::uint32_t>& frozen, MeshData& data);
  void give_back_input() noexcept;
  void check_promises() const;
  void note(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) watcher_.noted(text);
    result_.notes.insert(result_.notes.end(), texts.begin(), texts.end());
  }

  Mesh& user_mesh_;
  const Options& options_;
  face::Plan& plan_;
  const face::Figures figures_;
  face::Portrait* portrait_;  // null: nobody asked for one
  face::Follower* follower_;  // likewise
  face::Watcher watcher_;
  const std::filesystem::path file_;
  MeshData input_;  // to go back to, also when memory runs out; lengths as mesh_ has them
  Mesh unfilled_;   // takes it then, without asking for memory
  bool goes_back_ = false;
  bool carries_ = false;  // it holds more than mesh_ knows
  face::SurfaceMarks marks_;
  TetMesh mesh_;
  std::unique_ptr<TraceRecorder> trace_;
  Scale scale_;  // of mesh_
  std::size_t vertices_before_ = 0;
  std::uint64_t surface_before_ = 0;
  QualityIndicators first_;
  std::optional<P1Diagonals> diagonals_;  // of mesh_, from its building to its first change
  face::LocalLengths lengths_;
  std::shared_ptr<const SizeField> size_field_;
  std::shared_ptr<const CurvedEdges> curved_edges_;
  std::size_t notes_before_ = 0;
  std::vector<std::uint32_t> tet_numbers_;  // in the user's mesh, by slot
  Result result_;
};

/// A mesh that cannot be built is as before.
void Improvement::build() {
  watcher_.begin(Stage::building);
  const Stopwatch watch(result_.building);
  unfilled_ = MeshAccess::make({}, file_);
  input_ = MeshAccess::take(user_mesh_);
  vertices_before_ = input_.points.size();
  try {
    plan_.trace.locate(input_);
    face::find_regions(input_, options_);
    face::check_conserve(input_, options_.conserve);
    MeshData data = input_;
    carries_ = face::holds_more(data);
    if (!plan_.surface.is_fixed()) {
      marks_ = face::mark_surface(data);
      carries_ = carries_ || !data.point_labels.empty();
    }
    build_mesh(data);
  } catch (...) {
    give_back_input();
    throw;
  }
}

void Improvement::build_mesh(MeshData& data, Mending mending) {
  face::put_marks(marks_, data);
  face::name_constraints(data, !options_.ignore_interior);
  mesh_ = face::build_located(file_, data,
                              {.interior = options_.ignore_interior ? InteriorConstraints::dropped
                                                                    : InteriorConstraints::kept,
                               .report = &result_.build,
                               .tet_numbers = options_.maps || carries_ ? &tet_numbers_ : nullptr});
  if (scale_ != mesh_.scale()) {  // not when going back
    scale_ = mesh_.scale();
    for (Point& p : input_.points) p = scale_.to_work(p);  // cannot fail half-way
  }
  mesh_.set_standard(plan_.standard);
  const face::ProtectedPart part = face::protect(mesh_, options_);
  result_.protected_tets = part.tets;
  result_.protected_bad_tets = part.bad_tets;
  result_.layer_tets = part.layer_tets;
  result_.layer_bad_tets = part.layer_bad_tets;
  if (plan_.purpose.keeps_step) diagonals_ = p1_diagonals(mesh_);
  auto [bounds, holds_solver] = face::bounds_of_run(mesh_, diagonals_ ? &*diagonals_ : nullptr);
  result_.holds_solver = holds_solver;
  if (plan_.sizes.are_wanted()) {  // of another mesh than the one that is asked for
    bounds = Bounds();
    result_.holds_solver = false;
  }
  mesh_.set_bounds(mending == Mending::keeps_bounds ? bounds.for_mending() : bounds);
  if (!plan_.surface.is_fixed()) mesh_.set_surface_guard(plan_.surface.guard(mesh_, input_));
  hold_curved();
  if (plan_.sizes.are_wanted() && !size_field_) size_field_ = plan_.sizes.field(input_, mesh_);
  if (options_.keep_size && !size_field_) size_field_ = std::make_shared<UsualLengths>(mesh_);
  mesh_.set_size_field(size_field_);
}

/// Curved tets are kept from being turned over.
void Improvement::hold_curved() {
  if (input_.mid_nodes.empty()) return;
  if (!curved_edges_)
    curved_edges_ = std::make_shared<CurvedEdges>(input_, mesh_, !options_.ignore_interior);
  if (!curved_edges_->is_empty()) mesh_.set_curved_edges(curved_edges_);
}

void Improvement::measure_before() {
  watcher_.begin(Stage::measuring);
  const Stopwatch watch(result_.measuring);
  result_.before = compute_statistics(mesh_, options_.goal);
  first_ = quality_indicators(mesh_);
  if (curved_edges_) result_.curved_before = curved_statistics(input_, mesh_);
  if (plan_.sizes.are_wanted()) {
    result_.sizes_before = face::size_statistics(mesh_);
    note(face::remarks_on(*result_.sizes_before, options_));
  }
  // Whoever asks for them or not: the promises are held to them.
  result_.rulers_before = diagonals_ ? measure_rulers(mesh_, *diagonals_, cg_steps())
                                     : measure_rulers(mesh_, cg_steps());
  if (options_.rulers && figures_ == face::Figures::all) {
    lengths_ = face::LocalLengths(mesh_, vertices_before_);
  }
  surface_before_ = result_.surface_fingerprint_before = surface_fingerprint(mesh_);
  if (!plan_.surface.is_fixed())
    result_.surface_change = face::SurfaceTolerance::measure_before(mesh_);
  result_.not_positive_before = count_not_positive(mesh_, result_.before);
  note(deck_remarks(input_));
  note(face::advice_before(mesh_, result_));
  if (const auto most = plan_.growth.most(result_.before.tets);
      most && *most < result_.before.tets) {
    note({fmt::format("--tets {} is less than the {} tets that there are: none is added",
                      options_.tets, result_.before.tets)});
  }
  notes_before_ = result_.notes.size();
  if (portrait_ != nullptr) portrait_->draw_before(mesh_, result_.rulers_before);
}

/// Where lengths are wanted, the last bad tets are not worth most of the time: `improve` may follow.
ScheduleSettings Improvement::for_surface() const {
  if (!plan_.sizes.are_wanted()) return {};
  return {{"max_rounds", "2"}, {"most_worst", "50"}};
}

/// The passes of the schedule, or so many of them, for so many seconds; 0: without a limit.
void Improvement::run_schedule(std::size_t passes, double seconds) {
  diagonals_.reset();  // the mesh changes
  trace_.reset();      // of the run before, when going back
  trace_ = plan_.trace.start(mesh_, file_, plan_.schedule, plan_.settings);
  Run run(mesh_, plan_.registry);
  if (const auto most = plan_.growth.most(result_.before.tets)) run.set_most_tets(*most);
  run.set_listener(&watcher_);
  const face::ArrayValues values(input_);
  run.set_values(&values);
  const face::DataSoFar so_far = [this] { return data_so_far(); };
  run.set_trace(follower_ != nullptr ? follower_->follow(run, so_far) : trace_.get());
  contract::Inspector inspector;
  if (options_.check_operators) run.set_inspector(&inspector);
  watcher_.watch(&run, quality_indicators(mesh_));
  watcher_.begin(Stage::improving);
  {
    const Stopwatch watch(result_.improving);
    run.set_cancel_flag(options_.cancel);
    if (seconds > 0) run.set_time_limit(seconds);
    if (passes != kAllPasses) run.stop_after(passes);
    tetmend::improve(run, plan_.schedule, plan_.settings);
    // Where the fixed surface holds bad tets, it moves.
    if (!plan_.surface.is_fixed() && !run.cancelled()) {
      run.set_standard(plan_.standard);
      if (run.indicators().n_bad > 0)
        tetmend::improve(run, Schedule::builtin("surface"), for_surface());
    }
  }
  mesh_.renew_surface();
  // A script may aim higher for a while, and be stopped then.
  const Standard& last = mesh_.standard();
  run.set_standard(last.with_goal(options_.goal));
  watcher_.watch(nullptr, quality_indicators(mesh_));
  if (passes == kAllPasses) {
    result_.ending = run.out_of_time() ? Ending::time_limit
                     : run.cancelled() ? Ending::cancelled
                                       : Ending::finished;
  } else if (is_stopped()) {  // by the user, not by the number of passes
    result_.ending = Ending::cancelled;
  }
  result_.passes.clear();
  for (PassRecord& record : run.records) result_.passes.push_back(to_pass(std::move(record)));
  for (std::string& text : run.notes) result_.notes.push_back(std::move(text));
}

void Improvement::measure_after() {
  watcher_.begin(Stage::measuring);
  const Stopwatch watch(result_.measuring);
  result_.after = compute_statistics(mesh_, options_.goal);
  result_.rulers_after = measure_rulers(mesh_, cg_steps());
  if (options_.rulers && figures_ == face::Figures::all) {
    result_.size_drift = lengths_.drift_to(lengths_.renewed(mesh_));
  }
  if (curved_edges_) result_.curved_after = curved_edges_->statistics(mesh_);
  if (plan_.sizes.are_wanted()) result_.sizes_after = face::size_statistics(mesh_);
  result_.surface_fingerprint = surface_fingerprint(mesh_);
  if (result_.surface_change) {
    face::SurfaceTolerance::measure_after(mesh_, *result_.surface_change);
  }
  result_.not_positive_after = count_not_positive(mesh_, result_.after);
  result_.touched_tets = count_touched(mesh_);
  std::vector<std::pair<TetHandle, Hindrance>> hindrances;
  if (options_.limit) result_.limit = find_surface_limit(mesh_, options_.cancel, &hindrances);
  if (!result_.limit) hindrances.clear();
  if (portrait_ != nullptr) portrait_->draw_after(mesh_, hindrances, result_.rulers_after);
}

/// Passes up to the one that left the fewest bad tets, the last of such; 0 if all left more than
/// there were. Other figures may be worse there.
std::size_t Improvement::best_pass() const {
  std::size_t best = 0;
  std::size_t n_bad = first_.n_bad;
  for (std::size_t i = 0; i < result_.passes.size(); ++i) {
    if (result_.passes[i].after.n_bad > n_bad) continue;
    n_bad = result_.passes[i].after.n_bad;
    best = i + 1;
  }
  return best;
}

/// All passes, from the input on.
void Improvement::make_again(Mending mending, double seconds) {
  MeshData data = input_;
  scale_.to_file(data.points);
  result_.notes.resize(notes_before_);
  build_mesh(data, mending);
  run_schedule(kAllPasses, seconds);
  measure_after();
}

/// Mended tets have left a figure worse than before. Where each step keeps the bounds, as many can be
/// mended as a rule. Where not, inverted tets go first, and the figure stays in Result::worse(). A run
/// that was stopped, or has no time left for this, stays as it is.
void Improvement::mend_within_bounds() {
  // Time for this; who follows sees the run before once more.
  const bool is_limited = options_.time_limit > 0;
  const double runs = follower_ != nullptr ? 2 : 1;
  const double seconds = is_limited ? options_.time_limit - runs * result_.improving : 0;
  if (result_.ending != Ending::finished || seconds < (is_limited ? result_.improving : 0)) return;
  const std::size_t left = result_.not_positive_after;
  Made first = put_aside();
  try {
    make_again(Mending::keeps_bounds, seconds);
  } catch (...) {
    put_back(std::move(first));
    throw;
  }
  const bool is_cancelled = result_.ending == Ending::cancelled;
  const bool is_kept = result_.ending != Ending::time_limit && result_.not_positive_after <= left &&
                       result_.worse().empty();
  if (is_kept) return;
  if (follower_ != nullptr && !is_cancelled) {
    make_again(Mending::breaks_bounds, 0);
    return;
  }
  put_back(std::move(first));
  if (is_cancelled) result_.ending = Ending::cancelled;
}

Improvement::Made Improvement::put_aside() {
  return {std::move(mesh_), std::move(trace_), result_};
}

/// Instead of what was made since.
void Improvement::put_back(Made made) {
  mesh_ = std::move(made.mesh);
  trace_ = std::move(made.trace);
  made.result.building = result_.building;
  made.result.measuring = result_.measuring;
  made.result.improving = result_.improving;
  result_ = std::move(made.result);
  watcher_.watch(nullptr, quality_indicators(mesh_));
  if (portrait_ != nullptr) measure_after();  // which draws
}

/// Some figure is worse than before: makes the run again, up to its best pass; if one is worse there,
/// too, up to half as many, and so on: all that is at most two runs more. The same passes do the same, so
/// no state needs to be kept in memory. Who stops that gets what it has reached, if no figure is worse
/// there. A time limit holds once more, for all these runs together.
void Improvement::go_back() {
  goes_back_ = true;
  const std::string reason = fmt::format("{}", fmt::join(face::worse_for_nothing(result_), "; "));
  const std::size_t all = result_.passes.size();
  const bool is_limited = options_.time_limit > 0;
  const double end = result_.improving + options_.time_limit;
  const auto is_over = [&] { return is_stopped() || (is_limited && result_.improving >= end); };
  for (std::size_t passes = best_pass();; passes = is_over() ? 0 : passes / 2) {
    MeshData data = input_;
    scale_.to_file(data.points);
    result_.notes.resize(notes_before_);
    build_mesh(data);
    if (passes > 0) {
      run_schedule(passes, is_limited ? end - result_.improving : 0);
    } else {
      result_.passes.clear();
    }
    measure_after();
    if (passes > 0 && !face::worse_for_nothing(result_).empty()) continue;
    const std::size_t done = result_.passes.size();  // fewer where it was stopped on the way
    std::string text = fmt::format(
        "went back to the state after pass {} of {}: at the end there was {}", done, all, reason);
    if (passes > 0 && is_over())
      text += fmt::format("; it was stopped on the way to pass {}", passes);
    note({text});
    goes_back_ = false;
    return;
  }
}

void Improvement::map_entities() {
  if (!options_.maps && !carries_) return;
  auto vertices = face::map_vertices(mesh_, vertices_before_);
  result_.tet_map = face::map_tets(mesh_, tet_numbers_);
  result_.vertex_map = std::move(vertices);
}

/// The mesh as it is by now. As it was before if there is too little memory for that, or if it is
/// known to be worse.
void Improvement::give_back() {
  if (goes_back_) return give_back_input();
  const Stopwatch watch(result_.carrying);
  try {
    give_back_improved();
  } catch (...) {
    give_back_input();
    throw;
  }
}

/// In the user's mesh.
std::vector<std::uint32_t> Improvement::frozen_tets() const {
  std::vector<std::uint32_t> frozen;
  for (std::uint32_t slot = 0; slot < mesh_.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh_.is_deleted(t) || !mesh_.is_frozen(t)) continue;
    frozen.push_back(tet_numbers_[slot]);
  }
  return frozen;
}

/// By tet of `data`; empty where none is frozen.
std::vector<bool> marked(const std::vector<std::uint32_t>& frozen,
                         const std::vector<std::uint32_t>& tet_map, const MeshData& data) {
  std::vector<bool> is_frozen(frozen.empty() ? 0 : data.tets.size(), false);
  for (const std::uint32_t t : frozen) is_frozen[tet_map[t]] = true;
  return is_frozen;
}

/// Last of all: which edges there are is settled.
void Improvement::curve_inside(const std::vector<std::uint32_t>& frozen, MeshData& data) {
  if (!result_.curved_after || result_.curved_after->turned_over == 0) return;
  const face::Curving done =
      face::curve_inside(data, marked(frozen, result_.tet_map, data), options_.straighten);
  result_.curved_edges = done.curved;
  result_.straightened_edges = done.straightened;
  result_.curved_after = curved_statistics(data);
  note(done.notes);
}

void Improvement::give_back_improved() {
  // What the run and the measuring have freed lies in pieces of the heap. Given back, it makes room
  // for the arrays: about 10 bytes a tet less at the peak.
  platform::trim_heap();
  std::vector<std::uint32_t> frozen;
  if (result_.curved_after && result_.curved_after->turned_over > 0) frozen = frozen_tets();
  if (carries_ && result_.vertex_map.empty()) map_entities();  // the run failed half-way
  MeshData data = std::move(mesh_).to_data();
  if (carries_) {
    scale_.to_work(data.points);
    face::renew_mid_nodes(input_, result_.vertex_map, data);
    if (!input_.mid_nodes.empty()) {
      result_.after.vertices = data.points.size();
      if (result_.curved_after) result_.curved_after->mid_nodes = data.mid_nodes.size();
      curve_inside(frozen, data);
    }
    face::Carried carried =
        face::carry(input_, result_.vertex_map, result_.tet_map, options_.conserve, data,
                    plan_.surface.is_fixed() ? nullptr : &marks_);
    result_.carried = std::move(carried.arrays);
    note(carried.notes);
    if (!plan_.surface.is_fixed()) {
      face::label_surface_points(input_, result_.vertex_map, data);
    }
    scale_.to_file(data.points);
  }
  user_mesh_ = MeshAccess::make(std::move(data));
}

/// As give_back_improved(), of a copy, and nothing is told of how it came over.
MeshData Improvement::data_so_far() const {
  TetMesh mesh = mesh_;
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> tets;
  std::vector<std::uint32_t> frozen;
  if (carries_) {
    vertices = face::map_vertices(mesh, vertices_before_);
    tets = face::map_tets(mesh, tet_numbers_);
    if (!input_.mid_nodes.empty()) frozen = frozen_tets();
  }
  mesh.collect_garbage();  // in a pass the counts of the mesh lag behind
  MeshData data = std::move(mesh).to_data();
  if (!carries_) return data;
  scale_.to_work(data.points);
  face::renew_mid_nodes(input_, vertices, data);
  if (!data.mid_nodes.empty() && curved_statistics(data).turned_over > 0) {
    face::curve_inside(data, marked(frozen, tets, data), options_.straighten);
  }
  face::carry(input_, vertices, tets, options_.conserve, data,
              plan_.surface.is_fixed() ? nullptr : &marks_);
  if (!plan_.surface.is_fixed()) face::label_surface_points(input_, vertices, data);
  scale_.to_file(data.points);
  return data;
}

void Improvement::give_back_input() noexcept {
  // By one thread: a second one takes memory.
  if (!scale_.is_one()) {
    for (Point& p : input_.points) p = scale_.to_file(p);
  }
  MeshAccess::fill(unfilled_, std::move(input_));
  user_mesh_ = std::move(unfilled_);
}

/// A broken promise would be a bug of tetmend. Nobody is to work on with such a mesh.
void Improvement::check_promises() const {
  std::string_view broken;
  if (plan_.surface.is_fixed() &&
      (result_.surface_fingerprint != surface_before_ ||
       result_.after.boundary_triangles != result_.before.boundary_triangles)) {
    broken = "the surface changed";
  }
  if (result_.not_positive_after > result_.not_positive_before) broken = "a tet got inverted";
  const bool keeps_volume = plan_.surface.is_fixed() || plan_.surface.is_flat();
  if (keeps_volume && result_.not_positive_before == 0 &&
      !is_rounding(result_.volume_change(), result_.before.scaled_volume,
                   [&] { return longest_side(input_.points); })) {
    broken = "the volume changed";
  }
  if (broken.empty()) return;
  throw Error(
      fmt::format("the mesh is lost, for {}: this is a bug of tetmend, please report it", broken));
}

/// A promised figure that is worse than before.
struct Fall {
  std::string text;
  bool is_price = false;  // of inverted tets that were mended, which goes first
};

/// "0.33 instead of 0.34", with as many digits as tell them apart, `digits` at least.
std::string instead_of(double now, double then, int digits) {
  std::string shown = fmt::format("{:.{}g}", now, digits);
  std::string other = fmt::format("{:.{}g}", then, digits);
  if (shown == other && now != then && digits < std::numeric_limits<double>::max_digits10) {
    return instead_of(now, then, digits + 1);
  }
  return shown + " instead of " + other;
}

std::vector<Fall> falls_of(const Result& result) {
  constexpr double kRounding = 1e-9;
  constexpr double kEdgeRatio = 10;
  std::vector<Fall> falls;
  if (result.sizes_after) return falls;  // another mesh was asked for
  const auto compare = [&](std::string_view what, double now, double then, bool is_worse,
                           bool is_price = false) {
    if (!is_worse) return;
    falls.push_back({fmt::format("{} of {}", what, instead_of(now, then, 7)), is_price});
  };
  const MeshStatistics& before = result.before;
  const MeshStatistics& after = result.after;
  const bool is_mended = result.not_positive_after < result.not_positive_before;
  compare("a theta_min", after.theta_min, before.theta_min,
          after.theta_min < before.theta_min - kRounding, is_mended);
  const double most =
      result.holds_solver ? before.theta_max : std::max(before.theta_max, result.goal.max_angle);
  compare("a theta_max", after.theta_max, before.theta_max, after.theta_max > most + kRounding,
          is_mended);
  compare("a number of bad tets", static_cast<double>(after.n_bad),
          static_cast<double>(before.n_bad), after.n_bad > before.n_bad);
  compare("a lambda", after.lambda, before.lambda, after.lambda > before.lambda + kRounding);
  if (result.curved_before && result.curved_after) {
    const JacobianRatio& then = result.curved_before->worst;
    const JacobianRatio& now = result.curved_after->worst;
    compare("a worst Jacobian ratio", now.at_nodes, then.at_nodes,
            now.at_nodes < then.at_nodes - kRounding);
    compare("a bound of the Jacobian ratios", now.bound, then.bound,
            now.bound < then.bound - kRounding);
  }
  if (!result.rulers_before || !result.rulers_after) return falls;
  const auto worst = [](const MeshRulers& rulers, Ruler ruler) { return rulers[ruler].worst; };
  const double edge_ratio = worst(*result.rulers_before, Ruler::edge_ratio);
  for (const Ruler ruler : {Ruler::mean_ratio, Ruler::radius_ratio}) {
    const double now = worst(*result.rulers_after, ruler);
    const double then = worst(*result.rulers_before, ruler);
    compare(ruler == Ruler::mean_ratio ? "a worst mean ratio" : "a worst radius ratio", now, then,
            now < then - kRounding);
  }
  if (result.holds_solver) {
    const double now = worst(*result.rulers_after, Ruler::step);
    const double then = worst(*result.rulers_before, Ruler::step);
    compare("a stable step", now, then, now < then * (1 - kRounding));
  }
  const double most_ratio = std::max(edge_ratio, kEdgeRatio) + kRounding;
  compare("a worst edge ratio", worst(*result.rulers_after, Ruler::edge_ratio), edge_ratio,
          worst(*result.rulers_after, Ruler::edge_ratio) > most_ratio, is_mended);
  return falls;
}

}  // namespace

double Result::volume_change() const {
  const double difference = std::abs(after.scaled_volume - before.scaled_volume);
  return difference == 0 ? 0 : difference / std::abs(before.scaled_volume);
}

std::vector<std::string> Result::worse() const {
  std::vector<std::string> texts;
  for (Fall& fall : falls_of(*this)) texts.push_back(std::move(fall.text));
  return texts;
}

std::vector<std::string> Result::worse_than_before() const {
  std::vector<std::string> all = worse();
  for (std::string& aim : missed_aims()) all.push_back(std::move(aim));
  return all;
}

std::vector<std::string> face::worse_for_nothing(const Result& result) {
  std::vector<std::string> texts;
  for (Fall& fall : falls_of(result)) {
    if (!fall.is_price) texts.push_back(std::move(fall.text));
  }
  return texts;
}

std::vector<std::string> Result::missed_aims() const {
  std::vector<std::string> missed;
  if (!rulers_before || !rulers_after || sizes_after) return missed;
  for (const Ruler ruler : {Ruler::mean_ratio, Ruler::radius_ratio}) {
    const double then = (*rulers_before)[ruler].mean;
    const double now = (*rulers_after)[ruler].mean;
    if (now >= then) continue;
    const std::string_view name = ruler == Ruler::mean_ratio ? "mean ratio" : "radius ratio";
    missed.push_back(fmt::format("a mean {} of {}", name, instead_of(now, then, 4)));
  }
  if (rulers_after->faces_above_70 > rulers_before->faces_above_70) {
    missed.push_back(fmt::format("{} faces above 70 degrees instead of {}",
                                 rulers_after->faces_above_70, rulers_before->faces_above_70));
  }
  return missed;
}

Result face::improve(Mesh& mesh, const Options& options, std::unique_ptr<TraceRecorder>& trace,
                     Portrait* portrait, Figures figures) {
  Plan plan(options);
  if (!options.trace_piece.empty()) {
    throw OptionError("trace_piece", "trace_piece: the run is not in pieces");
  }
  TracePlan::check_files(options, mesh.file());
  return face::on_threads(face::threads_of(options), [&] {
    Improvement improvement(mesh, options, plan, portrait, nullptr, figures);
    Result result = improvement.run();
    trace = improvement.take_trace();
    return result;
  });
}

Result face::improve(Mesh& mesh, const Options& options, Follower& follower) {
  Plan plan(options);
  return face::on_threads(face::threads_of(options), [&] {
    return Improvement(mesh, options, plan, nullptr, &follower).run();
  });
}

Result face::improve(Mesh& mesh, const Options& options, Portrait* portrait) {
  std::unique_ptr<TraceRecorder> trace;
  Result result = improve(mesh, options, trace, portrait);
  try {
    if (trace) trace->finish();
  } catch (const Error& error) {  // the mesh is none the worse for it
    result.trace_trouble = error.what();
  }
  return result;
}

Result improve(Mesh& mesh, const Options& options) {
  return face::improve(mesh, options, nullptr);
}

Result adapt(Mesh& mesh, const Options& options) {
  if (options.size.empty() && !options.size_at) {
    throw OptionError("size", "size: adapt needs to know how long edges are to be");
  }
  Options adapting = options;
  if (options.script.empty() && options.schedule == Options().schedule) adapting.schedule = "adapt";
  return improve(mesh, adapting);
}

void check(const Options& options) {
  const face::Plan plan(options);
}

}  // namespace tetmend
