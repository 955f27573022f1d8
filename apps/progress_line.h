// SPDX-License-Identifier: MIT
// Progress of a run as one line of a terminal that is written over and over.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include <tetmend/improve.h>

namespace tetmend::apps {

/// Writes to stderr, about ten times a second; silent when stderr is not a terminal. The line is
/// cut to the width of the terminal and is gone after clear().
class ProgressLine {
 public:
  /// @param wanted false: silent
  explicit ProgressLine(bool wanted);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows a phase of unknown length, such as "reading tire.mesh".
  void show(std::string_view phase);
  void show(const Progress& progress);
  /// A line of its own, above. The report repeats the notes.
  void note(std::string_view text);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(std::string line);
  /// How long a phase that takes long still needs, if it goes on as it did; empty: not known.
  std::string rest_of(const Progress& progress, Clock::time_point now);

  bool active_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_drawn_{};
  std::string phase_;
  Clock::time_point phase_start_{};
  double share_ = 0;
  std::size_t drawn_width_ = 0;
};

}  // namespace tetmend::apps
