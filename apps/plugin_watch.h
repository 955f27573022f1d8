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

  /// In seconds; 0: none. What ends the program writes a line, leaves no unfinished files, and the
  /// exit status is 1.
  struct Limits {
    double attempt = 0;  ///< `tell` gets one line for each attempt that takes longer
    double time = 0;     ///< of the run: an attempt still under way two seconds later ends it
    double longest = 0;  ///< an attempt that takes longer ends the program
  };
  /// An attempt that is still under way two seconds after Interruption::requested() ends the
  /// program, too.
  PluginWatch(const Limits& limits, Tell tell);
  ~PluginWatch();
  PluginWatch(const PluginWatch&) = delete;
  PluginWatch& operator=(const PluginWatch&) = delete;

  /// The run is in this stage; the time limit counts from the beginning of Stage::improving.
  void show(Stage stage);

 private:
  using Clock = std::chrono::steady_clock;

  void watch();
  void look(Clock::time_point now);
  [[noreturn]] void end(std::string_view what, std::string_view why) const;

  const Limits limits_;
  const Tell tell_;
  Stage stage_ = Stage::building;
  std::atomic<Clock::time_point> deadline_{Clock::time_point::max()};
  Clock::time_point interrupted_ = Clock::time_point::max();  // when that was noticed
  std::vector<Clock::time_point> told_;  // when the attempts began of which it was said
  std::mutex busy_;
  std::condition_variable wake_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace tetmend::apps
