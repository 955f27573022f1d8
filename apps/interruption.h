// SPDX-License-Identifier: MIT
// Ctrl-C: the first asks the work to stop, the second ends the program at once.
#pragma once

#include <atomic>
#include <csignal>

namespace tetmend::apps {

/// While one lives, SIGINT and SIGTERM set a flag the first time and act as usual the second time.
/// A signal that the parent process chose to ignore (nohup) stays ignored. At most one at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static const std::atomic<bool>& requested();

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
};

}  // namespace tetmend::apps
