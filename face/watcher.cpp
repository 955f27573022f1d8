// SPDX-License-Identifier: MIT
// Tells a user how far a run has come, and stops it when the user says so.
#include "face/watcher.h"

namespace tetmend::face {

void Watcher::watch(Run* run, const QualityIndicators& before) {
  run_ = run;
  now_ = before;
  if (stopped_ && run_ != nullptr) run_->stop();
}

void Watcher::progress(std::string_view phase, unsigned round, double share) {
  tell({Stage::improving, phase, round, share, now_});
}

void Watcher::pass_done(std::string_view phase, unsigned round, const QualityIndicators& now) {
  now_ = now;
  tell({Stage::improving, phase, round, 1, now_});
}

void Watcher::noted(std::string_view text) {
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
  if (run_ != nullptr) run_->stop();
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

}  // namespace tetmend::face
