// SPDX-License-Identifier: MIT
// How many threads a command works on.
#include "apps/threads.h"

#include <CLI/CLI.hpp>

namespace tetmend::apps {

void add_threads_option(CLI::App& command, int& threads) {
  constexpr int kMaxThreads = 1024;
  command
      .add_option("--threads", threads,
                  "Worker threads, 1 to 1024 (default: 1); the\n"
                  "result is the same for every number")
      ->type_name("N")
      ->check(CLI::Range(1, kMaxThreads).description(""));
}

}  // namespace tetmend::apps
