// SPDX-License-Identifier: MIT
// Tells a user how far a run has come, and stops it when the user says so.
#pragma once

#include <exception>
#include <string_view>

#include <tetmend/improve.h>

#include "schedule/run.h"

namespace tetmend::face {

/// Calls Options::progress and Options::note. An exception of theirs stops the run; passes must not
/// see it.
class Watcher final : public ProgressListener {
 public:
  explicit Watcher(const Options& options) : options_(options) {}

  /// A stage begins.
  void begin(Stage stage) { tell({.stage = stage, .phase = {}, .now = now_}); }
  /// The run that is to be stopped; null: none any more.
  void watch(Run* run, const QualityIndicators& before);
  /// Throws what a call threw.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }
  bool stopped() const { return stopped_; }

  void progress(std::string_view phase, unsigned round, double share) override;
  void pass_done(std::string_view phase, unsigned round, const QualityIndicators& now) override;
  void noted(std::string_view text) override;

 private:
  void tell(const Progress& progress);
  void stop();
  template <class Call>
  void guarded(const Call& call);

  const Options& options_;
  Run* run_ = nullptr;
  QualityIndicators now_;
  bool stopped_ = false;
  std::exception_ptr error_;
};

}  // namespace tetmend::face
