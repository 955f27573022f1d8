// SPDX-License-Identifier: MIT
// The subcommands of tetmend. Each adds itself to the parser and leaves the action to be run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/error.h"

namespace CLI {
class App;
}
namespace tetmend {
class Ranks;
}
namespace tetmend::pieces {
class ArrayFiles;
}

namespace tetmend::apps {

/// The arguments are wrong, as can be told without work on a mesh: exit status 2 instead of 1.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// What the program's exit says. From 3 on the output was written.
enum Status : int { kSuccess = 0, kFailed = 1, kWrongUsage = 2, kGoalMissed = 3, kInterrupted = 4 };

/// Writes the message to standard error, in one line, and gives the status.
int complain(Status status, std::string_view message) noexcept;

/// What the user asked for. The parser fills in the action; main runs it.
struct Invocation {
  std::vector<std::string> arguments;      ///< without the name of the program
  std::function<int()> action;             ///< returns the exit status; @throws Error, UsageError
  std::filesystem::path folder_file = {};  ///< with options of the run; empty: none
  bool wrote_files = false;                ///< then what was said besides is not what counts
  Ranks* ranks = nullptr;                  ///< that all run the same command; null: it is alone
  const pieces::ArrayFiles* array_files = nullptr;  ///< of formats that only they know; null: none
  std::uint64_t first_vertex_id = 0;                ///< in pieces; cannot show: for tests of that
};

// Precondition of each: `invocation` outlives the parser.
void add_improve(CLI::App& app, Invocation& invocation);
void add_adapt(CLI::App& app, Invocation& invocation);
void add_quality(CLI::App& app, Invocation& invocation);
void add_check(CLI::App& app, Invocation& invocation);
void add_convert(CLI::App& app, Invocation& invocation);
void add_operators(CLI::App& app, Invocation& invocation);
void add_schedules(CLI::App& app, Invocation& invocation);
void add_check_plugin(CLI::App& app, Invocation& invocation);
void add_lesson(CLI::App& app, Invocation& invocation);
void add_surface(CLI::App& app, Invocation& invocation);
void add_pieces(CLI::App& app, Invocation& invocation);
void add_trace(CLI::App& app, Invocation& invocation);

}  // namespace tetmend::apps
