// SPDX-License-Identifier: MIT
#include "schedule/run.h"

#include <numeric>

namespace tetmend {

std::size_t PassRecord::attempts() const {
  return std::accumulate(verdicts.begin(), verdicts.end(), std::size_t{0});
}

Run::Run(TetMesh& mesh, const Registry& registry)
    : mesh_(mesh),
      registry_(registry),
      workspace_(mesh),
      scratch_(std::make_unique<Scratch>()),
      context_{mesh_, workspace_, *scratch_} {}

Date Run::begin_sweep(std::string_view calendar) {
  const Date now = workspace_.date() + 1;
  workspace_.set_date(now);
  for (auto& [name, date] : last_sweep_) {
    if (name == calendar) return std::exchange(date, now);
  }
  last_sweep_.emplace_back(calendar, now);
  return 0;
}

PassScope::PassScope(Run& run, std::string_view name)
    : run_(run), start_(std::chrono::steady_clock::now()) {
  record_.name = name;
  record_.round = run.round;
}

PassScope::~PassScope() {
  record_.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  record_.after = quality_indicators(run_.mesh());
  if (ProgressListener* listener = run_.listener())
    listener->pass_done(record_.name, record_.round, record_.after);
  run_.records.push_back(std::move(record_));
}

Verdict PassScope::attempt(const Operator& op, Target target) {
  const Verdict verdict = op.attempt(run_.context(), target);
  ++record_.verdicts[static_cast<std::size_t>(verdict)];
  return verdict;
}

bool PassScope::proceed(std::size_t done, std::size_t total) {
  constexpr std::size_t kTicksBetweenReports = 256;
  if (ticks_++ % kTicksBetweenReports == 0) {
    if (ProgressListener* listener = run_.listener()) {
      listener->progress(record_.name, record_.round,
                         total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1.0);
    }
  }
  return !run_.cancelled();
}

}  // namespace tetmend
