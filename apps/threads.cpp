// SPDX-License-Identifier: MIT
// How many threads a command works on.
#include "apps/threads.h"

#include <string>

#include <CLI/CLI.hpp>
#include <tetmend/option_text.h>

namespace tetmend::apps {

void add_threads_option(CLI::App& command, int& threads) {
  command
      .add_option_function<std::string>(
          "-j,--threads",
          [&threads](const std::string& text) {
            Options options;
            try {
              set_option(options, "threads", text);
            } catch (const OptionError& error) {
              throw CLI::ValidationError("--" + message_of(error));
            }
            threads = options.threads;
          },
          "Worker threads, 1 to 1024 (default: 1); the "
          "result is the same for every number")
      ->type_name("N");
}

}  // namespace tetmend::apps
