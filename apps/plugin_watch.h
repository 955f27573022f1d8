// SPDX-License-Identifier: MIT
// What becomes of a plugin that crashes or does not come back: its name is told.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include <tetmend/improve.h>

namespace tetmend::apps {

/// From now on a crash inside an attempt of a plugin prints a line with operator, plugin and target
/// and removes unfinished files, before it ends the program as it would have.
/// Precondition: no attempt of a plugin has been made.
void note_crashes();

/// Looks after the attempts of plugins while it lives, in a thread of its own.
class PluginWatch {
 public:
  using Tell = std::function<void(std::string_view)>;

  /// @param attempt_limit seconds; `tell` gets one line for each attempt that takes longer. 0: none
  /// @param time_limit seconds of the run. An attempt that is still under way two seconds later ends
  /// the program: with a line, without unfinished files, exit status 1. 0: none
  PluginWatch(double attempt_limit, double time_limit, Tell tell);
  ~PluginWatch();
  PluginWatch(const PluginWatch&) = delete;
  PluginWatch& operator=(const PluginWatch&) = delete;

  /// The run is in this stage; the time limit counts from the beginning of Stage::improving.
  void show(Stage stage);

 private:
  using Clock = std::chrono::steady_clock;

  void watch();
  void look(Clock::time_point now);
  [[noreturn]] void end(std::string_view what) const;

  const std::chrono::duration<double> attempt_limit_;
  const std::chrono::duration<double> time_limit_;
  const Tell tell_;
  Stage stage_ = Stage::building;
  std::atomic<Clock::time_point> deadline_{Clock::time_point::max()};
  std::vector<Clock::time_point> told_;  // when the attempts began of which it was said
  std::mutex busy_;
  std::condition_variable wake_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace tetmend::apps
