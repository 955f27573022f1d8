// SPDX-License-Identifier: MIT
// Tells a user how far a run has come, and stops it when the user says so.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <string_view>
#include <vector>

#include <tetmend/improve.h>

#include "schedule/run.h"

namespace tetmend::face {

/// Calls Options::progress and Options::note, one at a time. An exception of theirs stops the run;
/// passes must not see it.
class Watcher final : public ProgressListener {
 public:
  explicit Watcher(const Options& options) : options_(options) {}

  /// A stage begins.
  void begin(Stage stage) { tell({.stage = stage, .phase = {}, .now = now_}); }
  /// The run that is to be stopped; null: none any more. See WatchedRun for several.
  void watch(Run* run, const QualityIndicators& before);
  /// Throws what a call threw.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }
  bool stopped() const { return stopped_.load(std::memory_order_relaxed); }

  void progress(std::string_view phase, unsigned round, double share) override;
  void pass_done(std::string_view phase, unsigned round, const QualityIndicators& now) override;
  void noted(std::string_view text) override;

 private:
  friend class WatchedRun;

  void tell(const Progress& progress);
  void stop();
  template <class Call>
  void guarded(const Call& call);

  const Options& options_;
  std::mutex mutex_;  // several runs may work at a time
  std::vector<Run*> runs_;
  QualityIndicators now_;
  std::atomic<bool> stopped_ = false;
  std::exception_ptr error_;
};

/// A run on a part of a mesh, watched while this is there; others may be at the same time. The one that
/// began first tells how far it is, beside what the whole mesh was when the step began.
class WatchedRun final : public ProgressListener {
 public:
  /// @param watcher  null: nobody watches
  WatchedRun(Watcher* watcher, Run& run);
  ~WatchedRun() override;
  WatchedRun(const WatchedRun&) = delete;
  WatchedRun& operator=(const WatchedRun&) = delete;

  void progress(std::string_view phase, unsigned round, double share) override;
  void pass_done(std::string_view phase, unsigned round, const QualityIndicators& now) override;
  void noted(std::string_view text) override;

 private:
  Watcher* watcher_;
  Run& run_;
};

}  // namespace tetmend::face
