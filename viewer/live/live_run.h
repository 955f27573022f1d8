// SPDX-License-Identifier: MIT
// Live mode: a schedule with its parameters, run over a mesh again and again.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "schedule/schedule.h"
#include "viewer/live/live_job.h"

namespace tetmend::viewer {

/// Schedule and parameters may be changed at any time; what is at work keeps those that it began
/// with. For one thread.
class LiveRun {
 public:
  /// The default schedule with its defaults.
  LiveRun();

  /// Makes the operators of these plugins known, before any run. @throws Error as load_plugin().
  void load_plugins(std::span<const std::filesystem::path> files);
  /// The operators that plugins brought, by name.
  const std::vector<std::string>& plugin_operators() const { return plugin_operators_; }
  const Registry& registry() const { return registry_; }

  /// One that tetmend brings along, a file .lua, or "operator NAME": that operator alone. Parameters that the new one has, too, keep
  /// their values where they are valid. @throws Error as Schedule::find() and describe(), and
  /// nothing changes.
  void choose_schedule(const std::string& name_or_file);
  const std::string& schedule_name() const { return name_; }
  const ScheduleInfo& info() const { return info_; }

  /// `value` as a user writes it: "10", "true". @throws Error for an unknown name or a value of
  /// wrong type or range, and nothing changes.
  void set(const std::string& parameter, const std::string& value);
  /// What it was set to, or the default.
  std::string value_of(const ScheduleParameter& parameter) const;

  std::filesystem::path trace;  ///< the next runs are recorded into this file; empty: they are not

  bool paused = false;                  ///< the next runs are held before their first call
  std::vector<Breakpoint> breakpoints;  ///< after a change call tell_breakpoints()
  void tell_breakpoints();
  /// Changes a second, at once and in later runs; 0: as fast as it can. @throws Error below 0.
  void set_speed(double changes_a_second);
  double speed() const { return speed_; }

  struct Input {
    TetMesh mesh;
    MeshStatistics statistics;
    /// The mesh as its file has it, where that holds what a run respects and `mesh` does not know:
    /// parts, mid-side nodes. Null: there is no such thing.
    std::shared_ptr<const MeshData> data = nullptr;
  };
  enum class From : std::uint8_t {
    file,  ///< the mesh that the first run since forget() began with
    shown
  };
  /// Begins a run on `shown`, a mesh of `file`, or on a copy of the mesh before, both by the
  /// standard of `shown`. A file of a schedule is read again.
  /// @throws Error when a run is at work, or for a mistake in the file.
  void start(Input shown, From from, const std::filesystem::path& file);
  /// @throws Error when no run is at work.
  void ask(Demand demand);
  /// Ends a run that is at work, waits for that, and forgets the mesh. For one call, at most for a
  /// pass over the whole mesh.
  void forget();

  bool is_active() const;  ///< at work, or paused
  LiveState state() const { return job_ ? job_->state() : LiveState::idle; }
  LiveProgress progress() const { return job_ ? job_->progress() : LiveProgress(); }
  /// As LiveJob::wait(); at once when nothing is at work.
  LiveState wait(double seconds) const { return job_ ? job_->wait(seconds) : LiveState::idle; }
  std::unique_ptr<MeasuredMesh> take_snapshot() { return job_ ? job_->take_snapshot() : nullptr; }
  /// As LiveJob::whole_data(); null before the first run. @throws Error as that
  std::shared_ptr<const MeshData> whole_data() const;
  /// As LiveJob::last_calls(). @throws Error as that, and before the first run.
  std::string last_calls() const;
  /// From the next pass on an operator of the run has another value.
  /// @throws Error when none is at work, and for what the operator does not know or take.
  void hold_parameter(const ParameterHold& change);
  /// What the runs began with; null before the first.
  const Input* input() const { return input_.get(); }

 private:
  void check_trace(const std::filesystem::path& mesh) const;
  Schedule load(const std::string& name_or_file);
  Options options_for(const Schedule& schedule, const Standard& standard) const;
  std::vector<Condition> conditions() const;

  std::string name_;  // of a schedule, or its file
  ScheduleInfo info_;
  ScheduleSettings settings_;
  Registry registry_ = Registry::builtin();
  std::vector<std::filesystem::path> plugins_;
  std::vector<std::string> plugin_operators_;
  double speed_ = 0;
  std::unique_ptr<const Input> input_;
  std::unique_ptr<LiveJob> job_;
};

}  // namespace tetmend::viewer
