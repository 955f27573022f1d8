// SPDX-License-Identifier: MIT
// The options of `tetmend improve`, from the command line to the library.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tetmend/improve.h>

namespace CLI {
class App;
}

#include "apps/files.h"
#include "apps/piece_options.h"

namespace tetmend::apps {

/// As the user wrote them.
struct ImproveOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::vector<std::filesystem::path> reports;  ///< .json, .html or .htm
  bool verbose = false;
  bool quiet = false;
  bool dry_run = false;
  CarryOptions carry;
  std::string format;         ///< of "-"
  Options run;                ///< what the library reads
  std::string goal;           ///< 35 or 35,140; empty: none was asked for
  double attempt_limit = 10;  ///< seconds; 0: none
  PieceOptions pieces;
};

/// For an option: what is wrong with its text, or nothing.
std::string is_number_of_seconds(const std::string& text);

void add_improve_options(CLI::App& command, ImproveOptions& options);

/// --no-config, for commands that folder_options() knows.
void add_folder_option(CLI::App& command);

/// --dry-run, for a run that has the whole mesh in memory.
/// Of a command that has no other option of a run.
void add_goal_option(CLI::App& command, Options& options);
void add_dry_run_option(CLI::App& command, ImproveOptions& options);

/// The same, and those that say how long edges are to be.
void add_adapt_options(CLI::App& command, ImproveOptions& options);

/// Those that a run by `tetmend pieces` can have.
void add_options_of_pieces(CLI::App& command, ImproveOptions& options);

/// What is read besides the mesh: a schedule and plugins, also those that the environment names.
/// @throws Error as all_plugins()
std::vector<NamedFile> files_of_options(const Options& options);

/// What the help says of a SPEC, for the end of the command's help.
std::string region_help();

/// Fills in what of `run` has another form on the command line, and checks all of it.
/// @throws UsageError for a mistake; Error for a plugin, a script or a trace file that is none.
void complete(ImproveOptions& options);

}  // namespace tetmend::apps
