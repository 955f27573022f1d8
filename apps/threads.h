// SPDX-License-Identifier: MIT
// How many threads a command works on.
#pragma once

#include <cstddef>

#include <tbb/global_control.h>

namespace CLI {
class App;
}

namespace tetmend::apps {

/// Adds --threads, 1 to 1024.
void add_threads_option(CLI::App& command, int& threads);

/// While it lives, all work of the program is done on so many threads at most.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : control_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}

 private:
  tbb::global_control control_;
};

}  // namespace tetmend::apps
