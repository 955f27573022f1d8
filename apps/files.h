// SPDX-License-Identifier: MIT
// What the subcommands do with files: check their names early, say what loading a mesh found.
#pragma once

#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <tetmend/mesh.h>

#include "kernel/grouped.h"
#include "kernel/tet_mesh.h"

namespace CLI {
class App;
}
namespace tetmend::pieces {
class ArrayFiles;
}

namespace tetmend::apps {

/// @throws UsageError when no mesh format has the extension of `file`.
void check_mesh_extension(const std::filesystem::path& file);
/// ".json" of FILE.JSON.
std::string lower_extension(const std::filesystem::path& file);
/// @throws UsageError when the extension is none of `valid` (".json"); case does not matter.
void check_extension(const std::filesystem::path& file, std::span<const std::string_view> valid);

/// For "-", standard input or output, in place of a file.
void add_format_option(CLI::App& command, std::string& format);
/// Gives "-" the name under which the library knows the stream, "-.msh": `format` is "msh", or
/// "msh,vtu" for a command that reads one and writes the other.
/// @param output null for a command that writes no mesh
/// @throws UsageError when "-" has no format
void name_streams(const std::string& format, std::filesystem::path& input,
                  std::filesystem::path* output);
/// The name of a file or stream, for people.
std::string shown(const std::filesystem::path& file);
/// Where a command speaks to people: not where a mesh goes.
std::FILE* stream_beside(const std::filesystem::path& output);

/// A file that the user named, and how.
struct NamedFile {
  enum class Kind : unsigned char { plain, mesh, run_folder };

  std::string option;          ///< "--trace", "IN"
  std::filesystem::path file;  ///< empty: not named
  Kind kind = Kind::plain;
  bool in_place = false;  ///< of an input and an output: may be one mesh
};

/// @throws UsageError when two outputs, or an output and an input, are the same file, however they
/// are named. A mesh counts with all files that reading it opens or writing it makes, replaces or
/// removes.
/// @param known formats of meshes in several files; null: none
void check_distinct(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs,
                    const pieces::ArrayFiles* known);

/// What a command that writes files does first: check_distinct(), and try whether the outputs could
/// be written, which leaves everything as it was. What replacing an older file will change besides
/// its content is noted on standard error.
/// @throws Error with the reason, such as a folder that does not exist.
void prepare_files(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs,
                   const pieces::ArrayFiles* known);

/// What is written of the JSON: explain::printable_json(). Texts that change are named on standard error.
/// @param where it goes, for these notes
nlohmann::json printable_for(std::string_view where, const nlohmann::json& json);
/// The same to standard output.
void print_json(const nlohmann::json& json);

/// How a command reads a mesh that it writes again.
struct CarryOptions {
  std::string label_array;  ///< --label-array
  std::string variant;      ///< --variant
  bool strict = false;      ///< --strict
  bool replaces_tets = true;
};
void add_carry_options(CLI::App& command, CarryOptions& options);

/// @throws UsageError unless the format of `output` has the variant, if there is one.
void check_variant(const std::filesystem::path& output, const CarryOptions& options);

/// Names on standard error what of `input` the output will not have.
/// @param notes these sentences are added
/// @throws Error also when there are any and the options are strict
void tell_lost(const std::filesystem::path& input, const std::vector<std::string>& lost,
               const CarryOptions& options, std::vector<std::string>& notes);

/// Loads `input`. Names on standard error all of it that `output` will not have.
/// @param notes these sentences are added
/// @throws Error also when there are any and the options are strict
Mesh load_for(const std::filesystem::path& input, const std::filesystem::path& output, int threads,
              const CarryOptions& options, std::vector<std::string>& notes);

/// Names and extensions for help, one format a line.
std::string mesh_format_list();

/// What a user should know about the input, one line each; empty for a mesh without peculiarities.
std::string format_build(const BuildReport& report);
nlohmann::json to_json(const BuildReport& report);

}  // namespace tetmend::apps
