// SPDX-License-Identifier: MIT
// One run of a schedule: the mesh, the worker's tools, the calendar of passes, progress and
// cancellation.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/statistics.h"
#include "ops/registry.h"

namespace tetmend {

/// Told how far a run has come. Called often; must be quick.
class ProgressListener {
 public:
  virtual ~ProgressListener() = default;
  /// `share` of the phase that is done, 0 to 1.
  virtual void progress(std::string_view phase, unsigned round, double share) = 0;
  /// After each pass.
  virtual void pass_done(std::string_view phase, unsigned round, const QualityIndicators& now) = 0;
};

/// What one pass did.
struct PassRecord {
  std::string name;
  unsigned round = 0;
  double seconds = 0;
  std::array<std::size_t, 7> verdicts{};  ///< by Verdict
  QualityIndicators after;

  std::size_t attempts() const;
  std::size_t accepted() const { return verdicts[static_cast<std::size_t>(Verdict::accepted)]; }
};

/// State that passes share. A neighbourhood that has not changed since a pass last looked at it is
/// not tried again: each sweep of a pass has a date, commits write it to the vertices that they
/// change, and a pass remembers the date of its last sweep.
class Run {
 public:
  Run(TetMesh& mesh, const Registry& registry);

  TetMesh& mesh() { return mesh_; }
  const TetMesh& mesh() const { return mesh_; }
  const Registry& registry() const { return registry_; }
  OperatorContext& context() { return context_; }

  void set_listener(ProgressListener* listener) { listener_ = listener; }
  ProgressListener* listener() const { return listener_; }
  /// The run stops at the next consistent state once the flag is true.
  void set_cancel_flag(const std::atomic<bool>* flag) { cancel_ = flag; }
  bool cancelled() const { return cancel_ != nullptr && cancel_->load(std::memory_order_relaxed); }

  unsigned round = 0;  ///< of the schedule; 0 before the main loop
  std::vector<PassRecord> records;

  /// Starts a sweep; returns the date of the sweep before in the same calendar, 0 if there was
  /// none. Later commits carry the new date.
  Date begin_sweep(std::string_view calendar);

 private:
  TetMesh& mesh_;
  const Registry& registry_;
  Workspace workspace_;
  std::unique_ptr<Scratch> scratch_;
  OperatorContext context_;
  ProgressListener* listener_ = nullptr;
  const std::atomic<bool>* cancel_ = nullptr;
  std::vector<std::pair<std::string, Date>> last_sweep_;
};

/// Times one pass, counts its verdicts, reports progress; adds the record to the run when it ends.
class PassScope {
 public:
  PassScope(Run& run, std::string_view name);
  ~PassScope();
  PassScope(const PassScope&) = delete;
  PassScope& operator=(const PassScope&) = delete;

  /// Attempts and counts.
  Verdict attempt(const Operator& op, Target target);
  /// Reports progress now and then. False when the run is cancelled.
  bool proceed(std::size_t done, std::size_t total);

 private:
  Run& run_;
  PassRecord record_;
  std::chrono::steady_clock::time_point start_;
  std::size_t ticks_ = 0;
};

}  // namespace tetmend
