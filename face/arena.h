// SPDX-License-Identifier: MIT
// Work on a number of threads that the user chooses.
#pragma once

#include <algorithm>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tetmend/improve.h>

#include "kernel/error.h"

namespace tetmend::face {

inline void check_threads(int threads) {
  constexpr int kMost = 1024;
  if (threads >= 1 && threads <= kMost) return;
  throw OptionError("threads", fmt::format("threads: {} is outside 1 to {}", threads, kMost));
}

/// One where operators of the program are called, which may be no functions for several threads.
inline int threads_of(const Options& options) {
  check_threads(options.threads);
  return options.operators == nullptr ? options.threads : 1;
}

/// In an arena of its own, whatever arena the caller is in. No more threads than the machine has, or
/// the program allows: oneTBB would print a warning.
/// @throws OptionError for a number that makes no sense
template <class Work>
auto on_threads(int threads, const Work& work) {
  check_threads(threads);
  const auto allowed =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  tbb::task_arena arena(std::min(threads, static_cast<int>(allowed)));
  return arena.execute(work);
}

}  // namespace tetmend::face
