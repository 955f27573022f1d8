// SPDX-License-Identifier: MIT
// The one verb.
//
//   look at the options | build | measure | run the schedule | measure | compare | plain arrays again
//
// The plain arrays are taken apart on the way in, and the mesh on the way out: neither is in memory
// twice.
#include <chrono>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <tetmend/improve.h>

#include "face/advice.h"
#include "face/arena.h"
#include "face/maps.h"
#include "face/mesh_access.h"
#include "face/regions.h"
#include "face/registry.h"
#include "face/trace_plan.h"
#include "face/watcher.h"
#include "kernel/chunks.h"
#include "kernel/integrity.h"
#include "kernel/rulers.h"
#include "kernel/surface_fingerprint.h"
#include "schedule/limit/surface_limit.h"

namespace tetmend {

namespace {

/// Adds the time from its making to its end to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What the run and the measuring have freed lies in pieces of the heap. Given back, it makes room
/// for the arrays: about 10 bytes a tet less at the peak.
void trim_heap() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

Schedule find_schedule(const Options& options) {
  if (!options.script.empty()) return {"script", options.script};
  if (std::filesystem::path(options.schedule).extension() == ".lua") {
    return Schedule::from_file(options.schedule);
  }
  try {
    return Schedule::builtin(options.schedule);
  } catch (const Error& error) {
    throw OptionError("schedule", fmt::format("schedule: {}", error.what()));
  }
}

/// What the options stand for. Making it finds their mistakes.
struct Plan {
  Registry registry;
  Schedule schedule;
  face::TracePlan trace;

  explicit Plan(const Options& options)
      : registry(face::load_registry(options.plugin)),
        schedule(find_schedule(options)),
        trace(options, registry) {
    face::check_threads(options.threads);
    face::check_regions(options);
    if (!(options.time_limit >= 0)) {
      throw OptionError("time_limit", fmt::format("time_limit: {} is no time", options.time_limit));
    }
    const ScheduleInfo info = schedule.describe();
    try {
      check_settings(info, options.set);
    } catch (const Error& error) {
      throw OptionError("set", fmt::format("set: {}", error.what()));
    }
  }
};

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
  Improvement(Mesh& mesh, const Options& options, Plan& plan)
      : user_mesh_(mesh), options_(options), plan_(plan), watcher_(options), file_(mesh.file()) {}

  Result run() {
    build();
    try {
      measure_before();
      run_schedule();
      measure_after();
    } catch (...) {
      give_back();
      throw;
    }
    check_promises();
    give_back();
    watcher_.rethrow();
    return std::move(result_);
  }

 private:
  void build();
  void measure_before();
  void run_schedule();
  void measure_after();
  void check_promises() const;
  void note(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) watcher_.noted(text);
    result_.notes.insert(result_.notes.end(), texts.begin(), texts.end());
  }
  void give_back() {
    trim_heap();
    user_mesh_ = MeshAccess::make(std::move(mesh_).to_data());
  }

  Mesh& user_mesh_;
  const Options& options_;
  Plan& plan_;
  face::Watcher watcher_;
  const std::filesystem::path file_;
  TetMesh mesh_;
  std::size_t vertices_before_ = 0;
  std::uint64_t surface_before_ = 0;
  std::vector<std::uint32_t> tet_numbers_;  // in the user's mesh, by slot
  Result result_;
};

/// A mesh that cannot be built is as before.
void Improvement::build() {
  watcher_.begin(Stage::building);
  const Stopwatch watch(result_.building);
  MeshData data = MeshAccess::take(user_mesh_);
  vertices_before_ = data.points.size();
  try {
    plan_.trace.locate(data);
    face::find_regions(data, options_);
    mesh_ = face::build_located(file_, data,
                                {.interior = options_.ignore_interior ? InteriorConstraints::dropped
                                                                      : InteriorConstraints::kept,
                                 .report = &result_.build,
                                 .tet_numbers = options_.maps ? &tet_numbers_ : nullptr});
  } catch (...) {
    user_mesh_ = MeshAccess::make(std::move(data), file_);
    throw;
  }
  const face::ProtectedPart part = face::protect(mesh_, options_);
  result_.protected_tets = part.tets;
  result_.protected_bad_tets = part.bad_tets;
  result_.layer_tets = part.layer_tets;
  result_.layer_bad_tets = part.layer_bad_tets;
}

void Improvement::measure_before() {
  watcher_.begin(Stage::measuring);
  const Stopwatch watch(result_.measuring);
  result_.before = compute_statistics(mesh_);
  if (options_.rulers) result_.rulers_before = measure_rulers(mesh_);
  surface_before_ = surface_fingerprint(mesh_);
  result_.not_positive_before = count_not_positive(mesh_);
  note(face::advice_before(mesh_, result_));
}

void Improvement::run_schedule() {
  const auto trace = plan_.trace.start(mesh_, file_, plan_.schedule, options_.set);
  Run run(mesh_, plan_.registry);
  run.set_listener(&watcher_);
  run.set_cancel_flag(options_.cancel);
  run.set_trace(trace.get());
  watcher_.watch(&run, quality_indicators(mesh_));
  watcher_.begin(Stage::improving);
  {
    const Stopwatch watch(result_.improving);
    if (options_.time_limit > 0) run.set_time_limit(options_.time_limit);
    tetmend::improve(run, plan_.schedule, options_.set);
  }
  watcher_.watch(nullptr, quality_indicators(mesh_));
  result_.ending = run.out_of_time() ? Ending::time_limit
                   : run.cancelled() ? Ending::cancelled
                                     : Ending::finished;
  for (PassRecord& record : run.records) result_.passes.push_back(to_pass(std::move(record)));
  for (std::string& text : run.notes) result_.notes.push_back(std::move(text));
  if (trace) trace->finish();
}

void Improvement::measure_after() {
  watcher_.begin(Stage::measuring);
  const Stopwatch watch(result_.measuring);
  result_.after = compute_statistics(mesh_);
  if (options_.rulers) result_.rulers_after = measure_rulers(mesh_);
  result_.surface_fingerprint = surface_fingerprint(mesh_);
  result_.not_positive_after = count_not_positive(mesh_);
  result_.touched_tets = count_touched(mesh_);
  if (options_.limit) result_.limit = compute_surface_limit(mesh_);
  note(face::advice_after(mesh_, options_, result_));
  if (!options_.maps) return;
  result_.vertex_map = face::map_vertices(mesh_, vertices_before_);
  result_.tet_map = face::map_tets(mesh_, tet_numbers_);
}

/// A broken promise would be a bug of tetmend. Nobody is to work on with such a mesh.
void Improvement::check_promises() const {
  constexpr double kMostVolumeChange = 1e-9;
  std::string_view broken;
  if (result_.surface_fingerprint != surface_before_ ||
      result_.after.boundary_triangles != result_.before.boundary_triangles) {
    broken = "the surface changed";
  }
  if (result_.not_positive_after > result_.not_positive_before) broken = "a tet got inverted";
  if (result_.not_positive_before == 0 && result_.volume_change() > kMostVolumeChange) {
    broken = "the volume changed";
  }
  if (broken.empty()) return;
  throw Error(
      fmt::format("the mesh is lost, for {}: this is a bug of tetmend, please report it", broken));
}

}  // namespace

double Result::volume_change() const {
  const double difference = std::abs(after.volume - before.volume);
  return difference == 0 ? 0 : difference / std::abs(before.volume);
}

Result improve(Mesh& mesh, const Options& options) {
  Plan plan(options);
  return face::on_threads(options.threads, [&] { return Improvement(mesh, options, plan).run(); });
}

void check(const Options& options) {
  const Plan plan(options);
}

}  // namespace tetmend
