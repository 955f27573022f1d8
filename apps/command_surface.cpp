// SPDX-License-Identifier: MIT
// tetmend surface: triangles of a mesh for programs that show or compare surfaces.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/standard_streams.h"
#include "apps/threads.h"
#include "kernel/formats/tet_mesh_io.h"
#ifdef TETMEND_HAS_OPENMESH
#include "kernel/surface.h"
#endif

namespace tetmend::apps {
namespace {

struct Options {
  std::filesystem::path input;
  std::filesystem::path output;
  bool bad = false;
  bool constraints = false;
  int threads = 1;
};

#ifdef TETMEND_HAS_OPENMESH
constexpr const char* kPurpose = "Write the boundary of a mesh as triangles";

int run_surface(const Options& options, Invocation& invocation) {
  check_mesh_extension(options.input);
  try {
    check_surface_extension(options.output);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  const NamedFile input = {"IN", options.input};
  const NamedFile output = {"OUT", options.output};
  prepare_files({&input, 1}, {&output, 1});
  const ThreadLimit limit(options.threads);
  BuildReport build;
  const TetMesh mesh = read_tet_mesh(options.input, MeshOrder::of_file, &build);
  const SurfaceMesh surface = options.bad           ? extract_bad_faces(mesh)
                              : options.constraints ? extract_constraints(mesh)
                                                    : extract_boundary(mesh);
  write_surface(options.output, surface);
  invocation.wrote_files = true;
  say(stdout, fmt::format("{}: {} vertices, {} triangles\n", options.output.string(),
                          grouped(surface.mesh.n_vertices()), grouped(surface.mesh.n_faces())));
  return 0;
}
#else
constexpr const char* kPurpose = "Write the boundary as triangles (not in this build)";

int run_surface(const Options&, Invocation&) {
  throw UsageError("surface: tetmend was built without OpenMesh, which this command needs");
}
#endif

}  // namespace

void add_surface(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("surface", kPurpose);
  command->add_option("IN", options->input, "Mesh to read")->required()->type_name("");
  command->add_option("OUT", options->output, "File to write: .off, .obj, .ply or .stl")
      ->required()
      ->type_name("");
  CLI::Option* bad = command->add_flag("--bad", options->bad,
                                       "Instead of the boundary the faces of the bad tets\n"
                                       "(an angle under 30 or over 150 degrees)");
  command
      ->add_flag("--constraints", options->constraints,
                 "Instead of the boundary the faces inside the\n"
                 "volume that improving keeps: between two labels,\n"
                 "or named by the file")
      ->excludes(bad);
  add_threads_option(*command, options->threads);
  command->footer(fmt::format(
      R"(The triangles of the boundary are listed counterclockwise as seen from outside.
Where the surface is not manifold, vertices appear twice.

Mesh formats, by extension:
{}
Examples:
  tetmend surface part.mesh part.stl
  tetmend surface part.mesh slivers.ply --bad

Exit status: 0 success, 1 a file cannot be read or written, 2 wrong usage)",
      mesh_format_list()));
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] { return run_surface(*options, invocation); };
  });
}

}  // namespace tetmend::apps
