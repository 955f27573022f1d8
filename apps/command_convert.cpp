// SPDX-License-Identifier: MIT
// tetmend convert: the same mesh in another file format.
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tetmend/io.h>

#include "apps/commands.h"
#include "apps/convert_pieces.h"
#include "apps/files.h"
#include "apps/mesh_formats.h"
#include "apps/piece_options.h"
#include "apps/standard_streams.h"
#include "apps/threads.h"
#include "kernel/formats/packed_file.h"

namespace tetmend::apps {
namespace {

struct ConvertOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::vector<std::filesystem::path> more;
  std::string extension;         ///< --to: of the outputs; all that is named is read
  std::filesystem::path folder;  ///< --into: of the outputs; empty: that of the input
  bool json = false;
  bool quiet = false;
  CarryOptions carry;
  std::string format;
  std::size_t parts = 0;
  int threads = 1;
};

/// What was written, in one line.
void tell_written(const ConvertOptions& options, const Mesh& mesh,
                  const std::vector<std::string>& notes) {
  if (options.quiet) return;
  if (options.json) {
    const nlohmann::json json = {{"input", shown(options.input)},
                                 {"output", options.output.string()},
                                 {"vertices", mesh.point_count()},
                                 {"tets", mesh.tet_count()},
                                 {"triangles", mesh.triangle_count()},
                                 {"edges", mesh.edge_count()},
                                 {"lost", notes}};
    return say(stream_beside(options.output), printable_for("standard output", json).dump() + '\n');
  }
  say(stream_beside(options.output),
      fmt::format("{}: {} vertices, {} tets, {} triangles, {} edges\n", options.output.string(),
                  grouped(mesh.point_count()), grouped(mesh.tet_count()),
                  grouped(mesh.triangle_count()), grouped(mesh.edge_count())));
}

/// No adjacency is built, so that a mesh of broken topology can be converted too.
int convert_one(const ConvertOptions& options, Invocation& invocation) {
  const pieces::ArrayFiles& parts = *invocation.array_files;
  if (options.parts > 0 && !parts.is_in_parts(options.output)) {
    throw UsageError("--pieces: OUT is no mesh in parts");
  }
  if (parts.is_one(options.input) || parts.is_one(options.output)) {
    OneRank alone;
    convert_pieces(options.input, options.output, options.carry, &parts, options.parts, alone);
    invocation.wrote_files = true;
    return kSuccess;
  }
  check_input_format(options.input, &parts);
  check_mesh_extension(options.output);
  check_variant(options.output, options.carry);
  const NamedFile input = {"IN", options.input, NamedFile::Kind::mesh};
  const NamedFile output = {"OUT", options.output, NamedFile::Kind::mesh};
  prepare_files({&input, 1}, {&output, 1}, &parts);
  std::vector<std::string> notes;
  const Mesh mesh = load_for(options.input, options.output, options.threads, options.carry, notes);
  save(options.output, mesh, options.threads, options.carry.variant);
  invocation.wrote_files = true;
  tell_written(options, mesh, notes);
  return kSuccess;
}

/// Where each of several goes.
std::filesystem::path output_of(const ConvertOptions& options, const std::filesystem::path& input) {
  std::filesystem::path plain = input;
  if (formats::has_packed_name(plain)) plain.replace_extension();
  plain.replace_extension(options.extension);
  return options.folder.empty() ? plain : options.folder / plain.filename();
}

/// Mistakes of all are found before the first is written.
void check_several(const ConvertOptions& options, const std::vector<std::filesystem::path>& files,
                   const pieces::ArrayFiles& parts) {
  std::vector<NamedFile> inputs;
  std::vector<NamedFile> outputs;
  for (const auto& file : files) {
    if (file == "-" || !options.format.empty()) {
      throw UsageError("--to: it is for files, not for '-' and --format");
    }
    const std::filesystem::path output = output_of(options, file);
    if (!parts.is_in_parts(output)) {
      check_mesh_extension(output);
      check_variant(output, options.carry);
      if (options.parts > 0) throw UsageError("--pieces: OUT is no mesh in parts");
    }
    outputs.push_back({output.string(), output, NamedFile::Kind::mesh});
    if (std::error_code error; std::filesystem::exists(file, error)) {
      inputs.push_back({file.string(), file, NamedFile::Kind::mesh});
    }
  }
  check_distinct(inputs, outputs, &parts);
}

/// One that cannot be converted is named, and the others follow; the status is that of the worst.
int convert_several(ConvertOptions& options, Invocation& invocation) {
  std::vector<std::filesystem::path> files = {options.input};
  if (!options.output.empty()) files.push_back(options.output);
  files.insert(files.end(), options.more.begin(), options.more.end());
  check_several(options, files, *invocation.array_files);
  if (std::error_code error; !options.folder.empty()) {
    std::filesystem::create_directories(options.folder, error);  // if not, writing tells why
  }
  std::size_t failed = 0;
  for (const auto& file : files) {
    options.input = file;
    options.output = output_of(options, file);
    try {
      convert_one(options, invocation);
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      ++failed;
      complain(kFailed, error.what());
    }
  }
  if (!options.json && !options.quiet && files.size() > 1) {
    say(stdout, fmt::format("{} of {} meshes converted\n", grouped(files.size() - failed),
                            grouped(files.size())));
  }
  return failed > 0 ? kFailed : kSuccess;
}

int run_convert(ConvertOptions& options, Invocation& invocation) {
  if (!options.extension.empty()) {
    if (!options.extension.starts_with(".")) options.extension.insert(0, ".");
    return convert_several(options, invocation);
  }
  if (options.output.empty())
    throw UsageError("OUT is missing, or --to (see tetmend convert --help)");
  if (!options.folder.empty()) throw UsageError("--into: it needs --to");
  if (!options.more.empty()) {
    throw UsageError("several meshes need --to, the extension of what is written");
  }
  name_streams(options.format, options.input, &options.output);
  return convert_one(options, invocation);
}

}  // namespace

void add_convert(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = app.add_subcommand("convert", "Write a mesh in another file format");
  command->add_option("IN", options->input, "Mesh to read")->required()->type_name("");
  CLI::Option* const out =
      command->add_option("OUT", options->output, "File to write; with --to another mesh to read")
          ->type_name("");
  CLI::Option* const output =
      command->add_option("-o,--output", options->output, "The same as OUT")->type_name("OUT");
  output->excludes(out);
  command->add_option("MORE", options->more, "With --to: more meshes to read")->type_name("");
  command
      ->add_option(
          "--to", options->extension,
          "Read all that is named, and write each with this extension, such as vtu, beside "
          "it")
      ->type_name("EXT")
      ->excludes(output);
  command
      ->add_option("--into", options->folder,
                   "With --to: folder for what is written; it is\nmade where there is none")
      ->type_name("FOLDER");
  CLI::Option* const json =
      command->add_flag("--json", options->json, "Print JSON, a line for each mesh");
  command
      ->add_flag("-q,--quiet", options->quiet, "Print nothing but errors and what OUT cannot hold")
      ->excludes(json);
  add_carry_options(*command, options->carry);
  options->carry.replaces_tets = false;
  add_format_option(*command, options->format);
  add_threads_option(*command, options->threads);
  add_parts_option(*command, options->parts);
  command->footer(fmt::format(
      R"(Keeps points, elements, labels, named arrays and groups, and their order, as
far as the format of OUT can hold them; coordinates keep all their bits. What it
cannot hold is named on standard error. Nothing is repaired: a mesh whose
topology is broken, or whose tets are inverted, is converted as it is.

Formats, by extension:
{}A TetGen mesh is named by its .node or .ele file; its other files go with it.
A mesh in parts is named by its .pvtu file, or as part_%d.msh for part_1.msh,
part_2.msh and so on of Gmsh; of the latter labels and constraints alone are
kept. OUT in parts has tets in another order. No file of OUT may be one of IN.

Examples:
  tetmend convert part.mesh part.vtk
  tetmend convert part.ele part.meshb --strict
  tetmend convert part.mesh parts.pvtu --pieces 8
  tetmend convert part.vtu part.msh --variant "2.2 ASCII"
  tetmend convert meshes/*.msh --to vtu --into converted
  mesher | tetmend convert - part.vtu --format msh

Exit status: 0 success, 1 a file cannot be read or written, or --strict found
a loss, 2 wrong usage)",
      mesh_format_list()));
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] { return run_convert(*options, invocation); };
  });
}

}  // namespace tetmend::apps
