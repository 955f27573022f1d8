// SPDX-License-Identifier: MIT
// One run of a schedule in a thread of its own, which can be held, looked at and ended.
//
//   window:  ask(pause) ----.                       .--> progress(), take_snapshot()
//   thread:  call, call, call | hold: snapshot, wait |  call, call, ... | end of pass: snapshot
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <tetmend/improve.h>

#include "face/recorded.h"
#include "schedule/schedule.h"
#include "trace/recorder.h"
#include "viewer/live/live_breakpoints.h"
#include "viewer/live/live_memory.h"
#include "viewer/live/live_progress.h"
#include "viewer/mesh/measured_mesh.h"

namespace tetmend::viewer {

/// What a job is to do next.
enum class Demand : std::uint8_t {
  go_on,
  to_next_call,      ///< and pause after the next call, accepted or not
  to_next_accepted,  ///< and pause after the next call that changes the mesh
  to_next_pass,      ///< and pause after the pass
  pause,             ///< after the call at hand
  stop               ///< likewise; the mesh stays as it is then
};

struct LivePlan {
  Options options;              ///< of the run, as `tetmend improve` has them
  Schedule schedule;            ///< of these, for the trace
  std::filesystem::path input;  ///< name of the mesh, for the trace
  std::filesystem::path trace;  ///< file to record into; empty: none
  bool paused = false;          ///< before the first call
  double speed = 0;             ///< see LiveJob::set_speed()
  std::vector<Condition> breakpoints;
};

/// A parameter of an operator that the user has changed while the run was held.
struct ParameterHold {
  std::string operator_name;
  std::string parameter;
  double value = 0;
  /// "smoothing: cycles = 3"
  std::string text() const;
};

/// One `tetmend improve`, followed: layers, walls, bounds, comparison and the way back are its own, so
/// the result has its bytes. A run that goes back begins anew, with its passes and calls.
///
/// All member functions are for one other thread, or several. One thread makes all calls of the
/// schedule, so that a mesh that rests is that between two calls, or at a breakpoint inside of one
/// that of its trial, which may yet be undone. A job that is held costs nothing.
class LiveJob final : private TraceSink, private face::Follower {
 public:
  /// Begins to work on `mesh`. What comes of it is judged by `shown`, once the run is over.
  LiveJob(MeshData mesh, const Standard& shown, LivePlan plan);
  /// Ends the run and waits for that: for one call, or a pass over the whole mesh.
  ~LiveJob() override;
  LiveJob(const LiveJob&) = delete;
  LiveJob& operator=(const LiveJob&) = delete;

  /// Once stop was asked for nothing else counts.
  void ask(Demand demand);
  /// So many changes a second at most, each with a snapshot; 0: as fast as it can.
  void set_speed(double changes_a_second);
  /// Where the run is held, also inside of calls: at the beginning or the end of the call for which
  /// one of these holds, after an edit when the next call begins or the one at hand ends. One that
  /// is for good: after the outermost call.
  void set_breakpoints(std::vector<Condition> conditions);
  /// Holds from the next pass on, in this run; an event of its traces.
  /// Precondition: there is such a parameter, and it may have that value.
  void hold_parameter(ParameterHold change);
  /// Cost: copies the list of passes.
  LiveProgress progress() const;
  LiveState state() const;
  /// Returns when the run is paused or over, at the latest after so many seconds.
  LiveState wait(double seconds) const;

  /// The latest mesh that was not taken yet, or null. There is a new one whenever the run is held
  /// or over, and at ends of passes as long as they slow the run by less than a tenth.
  std::unique_ptr<MeasuredMesh> take_snapshot();

  /// The mesh with all that its file holds besides, as the run has it now. Null: there was nothing
  /// besides. @throws Error when the run is neither paused nor over. Cost: n log n while it is paused.
  std::shared_ptr<const MeshData> whole_data() const;

  /// A trace of the last calls of the schedule, at least kRemembered or all since it began, with the
  /// one under way. Empty: there was none. @throws Error when the run is neither paused nor over.
  std::string last_calls() const;
  static constexpr std::size_t kRemembered = 10000;

 private:
  using Clock = std::chrono::steady_clock;
  enum class Event : std::uint8_t { start, refused_call, accepted_call, pass_end };

  void work();
  void run();
  TraceSink* follow(Run& run, const face::DataSoFar& so_far) override;
  void need_rest() const;
  void begin_traces();
  void tell(const auto& event);
  void take_parameters();
  void show_pass(const QualityIndicators& now);
  void show(const Progress& progress);
  void show_note(std::string_view text);
  void come_to(Event event);
  void come_to_condition(const LiveCall& call);
  LiveCall call_of(const AttemptEvent& event) const;
  void hold(Demand demand);
  void dwell(double seconds);
  void take_breakpoints();
  void snap();
  void snap(TetMesh mesh);
  void publish();
  LiveState state_now() const;
  double seconds_until(Clock::time_point now) const;

  void pass_begins(std::string_view name, unsigned round) override;
  void pass_ends(const QualityIndicators& now) override;
  void visit_begins(const TetVertices& tet, Quality quality) override;
  void visit_ends() override;
  void standard_changed(const Standard& standard) override;
  void attempt_begins(const AttemptEvent& event) override;
  void candidate_found() override;
  void attempt_ends(Verdict verdict, std::span<const Quality> before,
                    std::span<const Quality> now) override;
  void edit_made(const TetMesh& mesh, const Journal& journal) noexcept override;
  void edit_undone() noexcept override;

  // Of the thread alone.
  MeshData data_;                  // before the run and after it
  const bool has_more_;            // than a mesh
  Run* run_ = nullptr;             // meanwhile
  face::DataSoFar so_far_;         // likewise
  const TetMesh* mesh_ = nullptr;  // likewise
  const Standard shown_by_;
  LivePlan plan_;
  std::unique_ptr<TraceRecorder> recorder_;
  LiveMemory memory_ = LiveMemory(kRemembered);
  std::size_t parameters_held_ = 0;  // the first of them, in this start of the run
  LiveBreakpoints breakpoints_;
  std::vector<LiveCall> calls_;  // that are under way, the outermost first
  std::optional<LiveCall> last_, last_accepted_;
  LivePass pass_;  // at work
  std::size_t attempts_ = 0;
  std::size_t accepted_ = 0;
  Clock::time_point pass_start_;
  Clock::duration held_before_pass_{0};
  Clock::time_point last_snapshot_;
  Clock::duration snapshot_cost_{0};

  std::atomic<Demand> demand_ = Demand::go_on;  // written under the lock
  std::atomic<bool> cancel_ = false;
  std::atomic<double> speed_ = 0;
  std::atomic<bool> has_new_breakpoints_ = false;
  mutable std::mutex lock_;
  mutable std::condition_variable changed_;
  // Under the lock.
  LiveProgress shown_;
  std::vector<Condition> new_breakpoints_;
  std::vector<ParameterHold> parameters_;
  bool is_held_ = false;
  bool is_over_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point held_since_;  // while held
  Clock::time_point end_;         // when over
  Clock::duration held_{0};       // altogether
  std::unique_ptr<MeasuredMesh> snapshot_;
  std::shared_ptr<const MeshData> result_;  // when over, with what else there is

  std::thread thread_;  // last: it uses the rest
};

}  // namespace tetmend::viewer
