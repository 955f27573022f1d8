// SPDX-License-Identifier: MIT
#include "apps/piece_options.h"

#include <CLI/CLI.hpp>
#include <tetmend/option_text.h>

#include "apps/number_check.h"
#include "kernel/error.h"
#include "platform/platform.h"

namespace tetmend::apps {

void add_parts_option(CLI::App& command, std::size_t& parts) {
  command
      .add_option("--pieces", parts,
                  "Files that a mesh in parts gets (default: one for each 4 million tets)")
      ->check(number_from(std::size_t{1}, std::size_t{65'535}))
      ->type_name("N");
}

void add_piece_options(CLI::App& command, PieceOptions& options) {
  command
      .add_option("--pieces", options.pieces,
                  "Divide the mesh into N pieces and work on one after another; the result "
                  "depends on N, 1 to 65535 (default: 1, or what --memory asks for)")
      ->check(number_from(std::size_t{1}, std::size_t{65'535}))
      ->type_name("N");
  command
      .add_option_function<std::string>(
          "--memory",
          [&options](const std::string& text) {
            Options size;  // sizes are written alike everywhere
            try {
              set_option(size, "trace-limit", text);
            } catch (const OptionError&) {
              throw CLI::ValidationError("--memory: '" + text +
                                         "' is not a size such as 2G (K, M or G)");
            }
            options.memory = size.trace_limit;
          },
          "Work out of core: at most about that much, such as 2G, is in memory at a time; 40M "
          "or more")
      ->type_name("SIZE");
  command
      .add_option("--scratch", options.scratch,
                  "Folder for the pieces that are not worked on (default: that of OUT)")
      ->type_name("FOLDER");
  command
      .add_option("--checkpoint", options.checkpoint,
                  "Keep the pieces there after each division; the same command goes on from them")
      ->type_name("FOLDER");
}

/// Taking it anew costs as much as what is done with it: each page is cleared by the system.
void reuse_memory() noexcept {
  constexpr int kFrom = 32 << 20;
  platform::give_back_blocks_from(kFrom);
}

}  // namespace tetmend::apps
