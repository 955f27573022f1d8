// SPDX-License-Identifier: MIT
// Runs work on a given number of threads, whatever the machine has.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace tetmend::test {

template <class Work>
auto on_threads(int threads, const Work& work) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(work);
}

}  // namespace tetmend::test
