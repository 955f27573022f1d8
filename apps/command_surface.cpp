// SPDX-License-Identifier: MIT
// tetmend surface: triangles of a mesh for programs that show or compare surfaces.
#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/mesh_formats.h"
#include "apps/number_check.h"
#include "apps/standard_streams.h"
#include "apps/threads.h"
#include "envelope/features.h"
#include "envelope/kept_points.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/mesh_view.h"
#ifdef TETMEND_HAS_OPENMESH
#include "kernel/surface.h"
#endif

namespace tetmend::apps {
namespace {

struct SurfaceOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  bool bad = false;
  bool constraints = false;
  bool features = false;
  bool flat = false;
  double feature_angle = FeatureOptions().angle;
  int threads = 1;
};

std::size_t count(const SurfaceFeatures& features, SurfacePlace place) {
  return static_cast<std::size_t>(
      std::count(features.places.begin(), features.places.end(), place));
}

void print_features(const char* name, const SurfaceFeatures& features) {
  say(stdout, fmt::format("{:<12}  {:>10}  {:>10}  {:>10}  {:>10}  {:>10}\n", name,
                          grouped(features.patches.size()), grouped(features.lines.size()),
                          grouped(count(features, SurfacePlace::corner)),
                          grouped(count(features, SurfacePlace::ridge)),
                          grouped(count(features, SurfacePlace::smooth))));
}

/// The mesh with numbers of patches and lines, from 1, for labels, and corners as required.
MeshData labelled(const TetMesh& mesh, const SurfaceFeatures& features) {
  MeshData data = mesh.to_data();
  const MeshView view(mesh);
  const auto slots = view.vertex_slots();
  std::vector<std::uint32_t> number(mesh.vertex_slots(), 0);
  for (std::uint32_t i = 0; i < data.points.size(); ++i) number[slots.empty() ? i : slots[i]] = i;
  const auto at = [&](VertexHandle v) { return number[v.index()]; };
  data.triangles.clear();
  for (const auto& face : features.faces) {
    const auto& v = face.vertices;
    data.triangles.push_back({{at(v[0]), at(v[1]), at(v[2])}, static_cast<Label>(face.patch + 1)});
  }
  data.edges.clear();
  for (const auto& edge : features.edges) {
    data.edges.push_back(
        {{at(edge.vertices[0]), at(edge.vertices[1])}, static_cast<Label>(edge.line + 1)});
  }
  data.required_vertices.clear();
  for (std::uint32_t i = 0; i < features.places.size(); ++i) {
    if (features.places[i] == SurfacePlace::corner) data.required_vertices.push_back(number[i]);
  }
  std::sort(data.required_vertices.begin(), data.required_vertices.end());
  return data;
}

int show_features(const SurfaceOptions& options, Invocation& invocation) {
  check_input_format(options.input, invocation.array_files);
  if (!options.output.empty()) check_mesh_extension(options.output);
  const NamedFile input = {"IN", options.input, NamedFile::Kind::mesh};
  const NamedFile output = {"OUT", options.output, NamedFile::Kind::mesh};
  prepare_files({&input, 1}, {&output, 1}, invocation.array_files);
  const ThreadLimit limit(options.threads);
  MeshData read = read_whole(options.input, invocation.array_files);
  const std::vector<char> points = find_kept_points(read);
  const TetMesh mesh = build_whole(options.input, std::move(read), nullptr, invocation.array_files);
  const std::vector<VertexHandle> kept = kept_vertices(mesh, points);
  const std::vector<VertexHandle> held = held_vertices(mesh, points);
  const SurfaceFeatures bent = find_features(
      mesh, {.angle = options.feature_angle, .flat = false, .kept = kept, .held = held});
  const SurfaceFeatures flat = find_features(
      mesh, {.angle = options.feature_angle, .flat = true, .kept = kept, .held = held});
  say(stdout, fmt::format("{}: {} triangles, feature angle {:g} degrees\n", options.input.string(),
                          grouped(bent.faces.size()), options.feature_angle));
  say(stdout, fmt::format("{:<12}  {:>10}  {:>10}  {:>10}  {:>10}  {:>10}\n", "", "patches",
                          "lines", "corners", "on lines", "in patches"));
  print_features("by angle", bent);
  print_features("exactly flat", flat);
  if (options.output.empty()) return 0;
  const MeshData data = labelled(mesh, options.flat ? flat : bent);
  write_mesh(options.output, MeshView(data));
  invocation.wrote_files = true;
  say(stdout, fmt::format("{}: triangles with their patches, {} edges with their lines, corners\n",
                          options.output.string(), grouped(data.edges.size())));
  return 0;
}

#ifdef TETMEND_HAS_OPENMESH
constexpr const char* kPurpose = "Write the boundary of a mesh as triangles";

int run_surface(const SurfaceOptions& options, Invocation& invocation) {
  check_input_format(options.input, invocation.array_files);
  try {
    check_surface_extension(options.output);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  const NamedFile input = {"IN", options.input, NamedFile::Kind::mesh};
  const NamedFile output = {"OUT", options.output, NamedFile::Kind::mesh};
  prepare_files({&input, 1}, {&output, 1}, invocation.array_files);
  const ThreadLimit limit(options.threads);
  const pieces::ArrayFiles* const parts = invocation.array_files;
  const TetMesh mesh = build_whole(options.input, read_whole(options.input, parts), nullptr, parts);
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

int run_surface(const SurfaceOptions&, Invocation&) {
  throw UsageError("surface: tetmend was built without OpenMesh, which this command needs");
}
#endif

void add_features(CLI::App& command, SurfaceOptions& options, CLI::Option* bad) {
  CLI::Option* features = command.add_flag("--features", options.features,
                                           "Count patches, feature lines and corners, and the\n"
                                           "vertices that improve --surface may move. OUT: the\n"
                                           "mesh with patches and lines as labels of triangles\n"
                                           "and edges, and corners as required vertices");
  features->excludes(bad);
  command.get_option("--constraints")->excludes(features);
  command
      .add_option("--feature-angle", options.feature_angle,
                  "Faces that bend by more degrees have a feature\n"
                  "line between them")
      ->capture_default_str()
      ->check(number_from(0.0, 180.0))
      ->needs(features);
  command
      .add_flag("--flat", options.flat,
                "OUT gets the patches that are exactly flat: what\n"
                "improve --surface flat works in")
      ->needs(features);
}

}  // namespace

void add_surface(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<SurfaceOptions>();
  CLI::App* command = app.add_subcommand("surface", kPurpose);
  command->add_option("IN", options->input, "Mesh to read")->required()->type_name("");
  command
      ->add_option("OUT", options->output,
                   "File to write: .off, .obj, .ply or .stl; with\n"
                   "--features a mesh, or none")
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
  add_features(*command, *options, bad);
  add_threads_option(*command, options->threads);
  command->footer(fmt::format(
      R"(The triangles of the boundary are listed counterclockwise as seen from outside.
Where the surface is not manifold, vertices appear twice.

Mesh formats, by extension:
{}{}
Examples:
  tetmend surface part.mesh part.stl
  tetmend surface part.mesh slivers.ply --bad
  tetmend surface part.mesh --features
  tetmend surface part.mesh patches.mesh --features --feature-angle 30

Exit status: 0 success, 1 a file cannot be read or written, 2 wrong usage)",
      mesh_format_list(), parts_help()));
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] {
      if (options->features) return show_features(*options, invocation);
      if (options->output.empty()) throw UsageError("surface: OUT is required");
      return run_surface(*options, invocation);
    };
  });
}

}  // namespace tetmend::apps
