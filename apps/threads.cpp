// SPDX-License-Identifier: MIT
// How many threads a command works on.
#include "apps/threads.h"

#include <string>

#include <CLI/CLI.hpp>
#include <tetmend/option_text.h>

#include "apps/option_help.h"

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
          help_of("threads"))
      ->type_name("N");
}

}  // namespace tetmend::apps
