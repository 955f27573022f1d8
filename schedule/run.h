// SPDX-License-Identifier: MIT
// One run of a schedule: the mesh, its workers, the calendar of passes, progress and cancellation.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "kernel/statistics.h"
#include "kernel/workspace.h"
#include "ops/registry.h"
#include "schedule/partition.h"
#include "schedule/selection.h"
#include "schedule/worker.h"

namespace tetmend {

class PassScope;

/// Told how far a run has come. Called often, by any thread, never by two at once; must be quick.
class ProgressListener {
 public:
  virtual ~ProgressListener() = default;
  /// `share` of the phase that is done, 0 to 1.
  virtual void progress(std::string_view phase, unsigned round, double share) = 0;
  /// After each pass.
  virtual void pass_done(std::string_view phase, unsigned round, const QualityIndicators& now) = 0;
  /// What the schedule has to say.
  virtual void noted(std::string_view) {}
  /// How long each block of a sweep took, in seconds: to measure how passes scale. A pass
  /// makes several such sweeps.
  virtual void blocks_done(std::span<const double> /*seconds*/) {}
};

/// What one pass did.
struct PassRecord {
  std::string name;
  unsigned round = 0;
  double seconds = 0;
  std::array<std::size_t, kVerdictCount> verdicts{};  ///< by Verdict
  std::size_t items = 0;                              ///< tets or vertices that were tried
  std::size_t deferred = 0;      ///< of them, those that had to be tried again with other borders
  double seconds_in_scans = 0;   ///< over the whole mesh
  double seconds_in_blocks = 0;  ///< of all threads together
  QualityIndicators after;

  std::size_t attempts() const;
  std::size_t accepted() const { return verdicts[static_cast<std::size_t>(Verdict::accepted)]; }
};

/// State that passes share. A neighbourhood that has not changed since a pass last looked at it is
/// not tried again. Each sweep of a pass has a date; commits write it to the vertices that they
/// change, and a pass remembers the date of its last sweep.
///
/// Passes use the threads of the caller's oneTBB arena. The mesh is divided into blocks by its size
/// alone, so that the result is the same, bit for bit, for every number of threads.
class Run {
 public:
  Run(TetMesh& mesh, const Registry& registry);

  TetMesh& mesh() { return mesh_; }
  const TetMesh& mesh() const { return mesh_; }
  const Registry& registry() const { return holding_ ? *holding_ : registry_; }
  /// From the next pass on, or from one that is just beginning, a parameter of an operator has this
  /// value, whatever the schedule says. Nothing counts as tried then.
  /// @throws Error as Registry::hold(). Precondition: no pass works.
  void hold_parameter(std::string_view operator_name, std::string_view parameter, double value);
  /// The worker of the whole mesh.
  Worker& worker() { return worker_; }

  /// From now on tets are judged by this standard. Nothing counts as tried then. Cost: linear.
  /// Precondition: no pass runs.
  void set_standard(const Standard& standard);
  /// Of the mesh between two passes.
  QualityIndicators indicators() const;
  /// From now on the mesh grows to at most that many tets, or not at all if it has more.
  void set_most_tets(std::size_t tets) { worker_.workspace().set_most_tets(tets); }
  /// The mesh is a part of a larger one, with `part` of its `whole` tets: where a schedule names a
  /// number of tets, that is of the larger one.
  /// Precondition: part <= whole, 0 < whole < 2^34, part < 2^30.
  void set_share(std::uint64_t part, std::uint64_t whole) { share_ = {part, whole}; }
  /// The selection as it is for this mesh.
  Selection for_share(const Selection& selection) const {
    return share_.part == share_.whole ? selection : selection.of_part(share_.part, share_.whole);
  }
  void set_listener(ProgressListener* listener) { listener_ = listener; }
  /// What selections may name besides measures. Null: nothing.
  void set_values(const TetValues* values) { values_ = values; }
  const TetValues* values() const { return values_; }
  /// The run stops at the next consistent state once the flag is true.
  void set_cancel_flag(const std::atomic<bool>* flag) { cancel_ = flag; }
  /// The same, now. May be called by any thread.
  void stop() { stopped_.store(true, std::memory_order_relaxed); }
  /// The run stops when that many passes are done. Precondition: fewer are.
  void stop_after(std::size_t passes) { most_passes_ = passes; }
  /// The run stops at the next consistent state that many seconds from now.
  void set_time_limit(double seconds);
  /// The run stops at the next consistent state when it has made about that many attempts more, the
  /// same ones for every number of threads: the tet that is just tried may take a few over.
  void set_most_attempts(std::size_t attempts) { attempts_left_ = attempts; }
  std::size_t attempts_left() const { return attempts_left_; }
  /// Something was left untried because attempts ran out, there at least.
  bool has_left_off() const { return has_left_off_; }
  void note_left_off() { has_left_off_ = true; }
  /// True once the run is to stop, for any of these reasons.
  bool cancelled() const { return attempts_left_ == 0 || flag_is_set() || out_of_time(); }
  /// True once the time limit was met, as far as anyone has looked at the clock.
  bool out_of_time() const { return out_of_time_.load(std::memory_order_relaxed); }
  /// The same, by a look at the clock.
  bool is_to_stop();
  /// Looks at the clock.
  void check_time();
  /// Since the run was made.
  double seconds() const;
  /// Passes, attempts and edits are told to the sink, by one thread. Null: no trace.
  void set_trace(TraceSink* trace);
  TraceSink* trace() const { return trace_; }
  /// All attempts go through the inspector, in one thread. Null: none.
  void set_inspector(AttemptInspector* inspector);
  /// Into as many blocks as its size asks for; a mesh that has grown since asks for more. Precondition:
  /// no pass works on it.
  void divide_by_size();
  /// For experiments: another number of blocks than the size of the mesh asks for. 1: no division.
  void set_block_count(std::size_t blocks);

  unsigned round = 0;  ///< of the schedule; 0 before the main loop
  std::vector<PassRecord> records;
  std::vector<std::string> notes;  ///< of the schedule
  /// Adds to the notes and tells the listener.
  void note(const std::string& text);
  /// Bytes of all that grows with each pass: records, notes, names of calendars. For who bounds them.
  std::size_t held_bytes() const { return held_bytes_; }

  /// What has changed before that date counts as tried. Precondition: no pass was made.
  void set_first_date(Date date);
  /// Starts a sweep; returns the date of the sweep before in the same calendar, the first date if
  /// there was none. Later commits carry the new date.
  Date begin_sweep(std::string_view calendar);

  // The rest is for sweeps; see sweep.h.

  /// How many partitions there are, with shifted blocks each; 0 for a mesh that is not divided.
  unsigned partition_count() const { return block_count_ > 1 ? kPartitions : 0; }
  Partition& partition(PassScope& scope, unsigned shift);
  /// Calls `work` on every thread of the arena, with a worker of its own. The first exception comes
  /// out when all calls have ended.
  void on_all_threads(const std::function<void(Worker&)>& work);
  /// Takes over what workers did in their territories. Precondition: none is active. When memory
  /// runs out, the mesh and the counts are right all the same.
  void collect_from_workers(PassScope& scope);
  /// New vertices of a worker get a block in every partition before it is used next; where memory
  /// runs out, when the worker is asked again.
  void note_added_vertices(Worker& worker);
  /// Tells the listener, unless another thread is just doing so.
  void report_progress(std::string_view phase, double share);
  void report_done(const PassRecord& record);
  void report_blocks(std::span<const double> seconds);

 private:
  static constexpr unsigned kPartitions = 12;
  struct ShiftedBlocks {
    std::unique_ptr<Partition> partition;  // made when first needed
    std::vector<VertexHandle> added;       // since it was last used
  };

  TetMesh& mesh_;
  const Registry& registry_;
  std::unique_ptr<Registry> holding_;  // in its place, once a parameter is held
  Worker worker_;
  tbb::enumerable_thread_specific<std::unique_ptr<Worker>> workers_;
  std::size_t block_count_ = 1;
  std::array<ShiftedBlocks, kPartitions> partitions_;
  ProgressListener* listener_ = nullptr;
  const TetValues* values_ = nullptr;
  std::mutex listener_busy_;
  bool flag_is_set() const {
    return stopped_.load(std::memory_order_relaxed) ||
           (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed));
  }

  struct Share {
    std::uint64_t part = 1, whole = 1;
  };
  Share share_;
  std::size_t attempts_left_ = std::numeric_limits<std::size_t>::max();
  bool has_left_off_ = false;
  std::size_t most_passes_ = std::numeric_limits<std::size_t>::max();
  std::atomic<bool> stopped_ = false;
  const std::atomic<bool>* cancel_ = nullptr;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point deadline_ = std::chrono::steady_clock::time_point::max();
  std::atomic<bool> out_of_time_ = false;
  TraceSink* trace_ = nullptr;
  AttemptInspector* inspector_ = nullptr;
  Date first_date_ = 0;
  std::vector<std::pair<std::string, Date>> last_sweep_;
  std::size_t held_bytes_ = 0;
  bool is_measured_ = false;  // the last record has the indicators of the mesh as it is

  friend class PassScope;
};

/// Times one pass, counts its verdicts, reports progress. finish() adds the record to the run; a pass
/// that an exception ends has none, and nothing counts as tried then.
class PassScope {
 public:
  PassScope(Run& run, std::string_view name);
  ~PassScope();
  PassScope(const PassScope&) = delete;
  PassScope& operator=(const PassScope&) = delete;

  /// Measures the mesh, records the pass and tells the trace and the listener. Nothing may follow.
  void finish();

  /// Times a scan of the whole mesh.
  class Scan {
   public:
    explicit Scan(PassScope& scope) : scope_(scope) {}
    ~Scan();
    Scan(const Scan&) = delete;
    Scan& operator=(const Scan&) = delete;

   private:
    PassScope& scope_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  };

  /// Indicators of the mesh, which between passes must not be changed. Measured when something was
  /// tried since the last time; timed as a scan.
  const QualityIndicators& indicators();
  /// See Run::set_values().
  const TetValues* values() const { return run_.values(); }
  /// Those that selections may name besides measures of tetmend.
  std::span<const Standard> measures() const { return run_.registry().measures(); }
  /// Attempts so far that were accepted.
  std::size_t accepted() const { return record_.accepted(); }
  /// That many items will be tried.
  void expect(std::size_t items);
  /// Asked before the n-th item of some range, by any thread. Reports progress now and then. False
  /// when the run is cancelled.
  bool proceed(std::size_t n);
  void take_verdicts(Worker& worker);
  void note_deferred(std::size_t items) { record_.deferred += items; }
  /// The time of each block of a sweep.
  void note_blocks(std::span<const double> seconds);

 private:
  Run& run_;
  PassRecord record_;
  std::chrono::steady_clock::time_point start_;
  std::atomic<std::size_t> ticks_ = 0;
  std::size_t expected_ = 0;
  bool measured_ = false;  // record_.after is right
  bool finished_ = false;
};

/// Makes a pass of `work(scope)`.
template <class Work>
void make_pass(Run& run, std::string_view name, const Work& work) {
  PassScope scope(run, name);
  work(scope);
  scope.finish();
}

}  // namespace tetmend
