// SPDX-License-Identifier: MIT
// tetmend convert: the same mesh in another file format.
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tetmend/io.h>

#include "apps/commands.h"
#include "apps/convert_pieces.h"
#include "apps/files.h"
#include "apps/piece_options.h"
#include "apps/standard_streams.h"
#include "apps/threads.h"

namespace tetmend::apps {
namespace {

struct ConvertOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  CarryOptions carry;
  std::string format;
  std::size_t parts = 0;
  int threads = 1;
};

/// No adjacency is built, so that a mesh of broken topology can be converted too.
int run_convert(ConvertOptions& options, Invocation& invocation) {
  name_streams(options.format, options.input, &options.output);
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
  check_mesh_extension(options.input);
  check_mesh_extension(options.output);
  check_variant(options.output, options.carry);
  const NamedFile input = {"IN", options.input, NamedFile::Kind::mesh};
  const NamedFile output = {"OUT", options.output, NamedFile::Kind::mesh};
  prepare_files({&input, 1}, {&output, 1}, &parts);
  std::vector<std::string> notes;
  const Mesh mesh = load_for(options.input, options.output, options.threads, options.carry, notes);
  save(options.output, mesh, options.threads, options.carry.variant);
  invocation.wrote_files = true;
  say(stream_beside(options.output),
      fmt::format("{}: {} vertices, {} tets, {} triangles, {} edges\n", options.output.string(),
                  grouped(mesh.point_count()), grouped(mesh.tet_count()),
                  grouped(mesh.triangle_count()), grouped(mesh.edge_count())));
  return 0;
}

}  // namespace

void add_convert(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = app.add_subcommand("convert", "Write a mesh in another file format");
  command->add_option("IN", options->input, "Mesh to read")->required()->type_name("");
  command->add_option("OUT", options->output, "File to write")->required()->type_name("");
  add_carry_options(*command, options->carry);
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
  mesher | tetmend convert - part.vtu --format msh

Exit status: 0 success, 1 a file cannot be read or written, or --strict found
a loss, 2 wrong usage)",
      mesh_format_list()));
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] { return run_convert(*options, invocation); };
  });
}

}  // namespace tetmend::apps
