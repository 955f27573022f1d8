// SPDX-License-Identifier: MIT
// Tells a user how far a run has come, and stops it when the user says so.
#include "face/watcher.h"

namespace tetmend::face {

void Watcher::watch(Run* run, const QualityIndicators& before) {
  runs_.clear();
  if (run != nullptr) runs_.push_back(run);
  now_ = before;
  if (stopped() && run != nullptr) run->stop();
}

void Watcher::progress(std::string_view phase, unsigned round, double share) {
  const std::lock_guard lock(mutex_);
  tell({Stage::improving, phase, round, share, now_});
}

void Watcher::pass_done(std::string_view phase, unsigned round, const QualityIndicators& now) {
  const std::lock_guard lock(mutex_);
  now_ = now;
  tell({Stage::improving, phase, round, 1, now_});
}

void Watcher::noted(std::string_view text) {
  const std::lock_guard lock(mutex_);
  if (options_.note) guarded([&] { options_.note(text); });
}

void Watcher::tell(const Progress& progress) {
  if (!options_.progress) return;
  guarded([&] {
    if (!options_.progress(progress)) stop();
  });
}

void Watcher::stop() {
  stopped_ = true;
  for (Run* const run : runs_) run->stop();
}

template <class Call>
void Watcher::guarded(const Call& call) {
  if (error_) return;
  try {
    call();
  } catch (...) {
    error_ = std::current_exception();
    stop();
  }
}

WatchedRun::WatchedRun(Watcher* watcher, Run& run) : watcher_(watcher), run_(run) {
  if (watcher_ == nullptr) return;
  run_.set_listener(this);
  run_.set_cancel_flag(watcher_->options_.cancel);
  const std::lock_guard lock(watcher_->mutex_);
  watcher_->runs_.push_back(&run_);
  if (watcher_->stopped()) run_.stop();
}

WatchedRun::~WatchedRun() {
  if (watcher_ == nullptr) return;
  run_.set_listener(nullptr);
  const std::lock_guard lock(watcher_->mutex_);
  std::erase(watcher_->runs_, &run_);
}

void WatchedRun::progress(std::string_view phase, unsigned round, double share) {
  const std::lock_guard lock(watcher_->mutex_);
  if (watcher_->runs_.front() != &run_) return;
  watcher_->tell({Stage::improving, phase, round, share, watcher_->now_});
}

void WatchedRun::pass_done(std::string_view phase, unsigned round,
                           const QualityIndicators& /*now*/) {
  progress(phase, round, 1);
}

void WatchedRun::noted(std::string_view text) {
  watcher_->noted(text);
}

}  // namespace tetmend::face
