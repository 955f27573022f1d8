// SPDX-License-Identifier: MIT
// Progress of a run as one line of a terminal that is written over and over.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "schedule/run.h"

namespace tetmend::apps {

/// Writes to stderr, about ten times a second; silent when stderr is not a terminal. The line is
/// cut to the width of the terminal and is gone after clear().
class ProgressLine : public ProgressListener {
 public:
  /// @param wanted false: silent
  explicit ProgressLine(bool wanted);
  ~ProgressLine() override { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows a phase of unknown length, such as "reading tire.mesh".
  void show(std::string_view phase);
  /// The mesh as it is before the first pass.
  void set_indicators(const QualityIndicators& now) { now_ = now; }
  void clear();

  void progress(std::string_view phase, unsigned round, double share) override;
  void pass_done(std::string_view phase, unsigned round, const QualityIndicators& now) override;
  void noted(std::string_view text) override;

 private:
  using Clock = std::chrono::steady_clock;
  void draw(std::string line);

  bool active_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_drawn_{};
  std::size_t drawn_width_ = 0;
  QualityIndicators now_;
};

}  // namespace tetmend::apps
