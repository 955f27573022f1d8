// SPDX-License-Identifier: MIT
// What a signal from outside does: it ends the program without remains, or asks the work to stop.
#pragma once

#include <atomic>

namespace tetmend::apps {

/// From now on SIGHUP, SIGINT and SIGTERM remove unfinished files before they end the program; so
/// does std::terminate(), with a line on standard error and status 1. A file beyond a limit is an
/// error of writing. A signal that the parent process chose to ignore (nohup) stays ignored.
void end_without_remains();

/// While one lives, these signals set a flag the first time and end the program the second time. At
/// most one at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static const std::atomic<bool>& requested();
};

}  // namespace tetmend::apps
