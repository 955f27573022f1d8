// SPDX-License-Identifier: MIT
//   embedded PLUGIN
// What a larger program does with the library: the examples of docs/library.md, run.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <tetmend/catalogue.h>
#include <tetmend/improve.h>
#include <tetmend/measure.h>

namespace {

struct Solver {
  std::vector<std::array<double, 3>> nodes;
  std::vector<std::array<std::uint32_t, 4>> cells;
  std::vector<std::int32_t> materials;  // of the cells
  std::vector<double> temperatures;     // at the nodes
  std::vector<std::uint32_t> held;      // nodes of the surface
};

void improve_mesh_of(Solver& solver) {
  tetmend::Mesh mesh({.points = solver.nodes,
                      .tets = solver.cells,
                      .tet_labels = solver.materials,
                      .point_data = {{"temperature", 1, solver.temperatures}}});
  const tetmend::Result result = tetmend::improve(mesh, {.threads = 4});

  for (std::uint32_t& node : solver.held) node = result.vertex_map[node];
  tetmend::MeshArrays arrays = std::move(mesh).take_arrays();
  auto& temperatures = std::get<std::vector<double>>(arrays.point_data[0].values);
  solver = {std::move(arrays.points), std::move(arrays.tets), std::move(arrays.tet_labels),
            std::move(temperatures), std::move(solver.held)};
}

bool is_usable(const std::string& file) {
  try {
    const tetmend::Measurement measured = tetmend::measure(tetmend::load(file));
    return measured.statistics.theta_min > 5 && measured.statistics.inverted == 0;
  } catch (const tetmend::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());  // part.mesh:1234: tet 17 ...: a face of it has ...
    return false;
  }
}

std::atomic<bool> stop_button = false;

tetmend::Ending improve_watched(tetmend::Mesh& mesh) {
  tetmend::Options options;
  options.cancel = &stop_button;
  options.progress = [](const tetmend::Progress& progress) {
    if (progress.stage == tetmend::Stage::improving) {
      std::printf("%s: %zu bad tets\n", std::string(progress.phase).c_str(), progress.now.n_bad);
    }
    return true;  // false stops the run
  };
  return tetmend::improve(mesh, options).ending;
}

tetmend::Result improve_by_own_script(tetmend::Mesh& mesh, const std::string& plugin) {
  tetmend::Options options;
  options.script = R"(
    local steps = parameter{"steps", default = 2, low = 1, high = 9}
    for i = 1, steps do
      begin_round()
      local_reconnection{}
      apply({"odt_smoothing", halvings = 4}, {on = {below = 1.2}})
      log("bad tets:", quality().n_bad)
    end)";
  options.set = {{"steps", "3"}};
  options.plugin = {plugin};
  return tetmend::improve(mesh, options);
}

/// Steps of a solver that moves the nodes of its mesh; a node is asked for by its number.
std::size_t follow(tetmend::Mesh mesh, int steps, double way) {
  tetmend::Improver session(std::move(mesh), {.threads = 4});
  std::uint32_t probe = 0;  // a node that must stay where the solver put it
  session.hold([&](std::uint32_t node) { return node == probe; });
  std::size_t touched = 0;
  for (int i = 0; i < steps; ++i) {
    std::vector<std::array<double, 3>> nodes(session.mesh().points().begin(),
                                             session.mesh().points().end());
    for (auto& [x, y, z] : nodes) x += way / steps * z;
    if (!session.move(nodes)) break;  // a tet would turn over: shorter steps, please
    const tetmend::ImproverStep step = session.improve(20000);
    probe = step.vertex_map[probe];
    touched += step.touched_tets;
  }
  return touched;
}

/// Prints and ends the program when a promise of the page is broken.
void expect(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "broken: %s\n", promise);
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const tetmend::Mesh part = tetmend::load("part.mesh");
  Solver solver;
  solver.nodes.assign(part.points().begin(), part.points().end());
  solver.cells.assign(part.tets().begin(), part.tets().end());
  solver.materials.assign(part.tet_labels().begin(), part.tet_labels().end());
  for (const auto& node : solver.nodes) solver.temperatures.push_back(300 + node[0]);
  solver.held = {part.triangles()[0][0]};
  const std::array<double, 3> held = solver.nodes[solver.held[0]];
  improve_mesh_of(solver);
  expect(solver.temperatures.size() == solver.nodes.size(), "a temperature for each node");
  expect(solver.materials.size() == solver.cells.size(), "a material for each cell");
  for (std::size_t i = 0; i < solver.nodes.size(); ++i) {
    expect(std::abs(solver.temperatures[i] - 300 - solver.nodes[i][0]) < 1e-9,
           "data are linear in the old mesh");
  }
  expect(solver.nodes[solver.held[0]] == held, "nodes of the surface stay where they were");
  expect(is_usable("better.mesh"), "a mesh that was improved is usable");
  expect(!is_usable("missing.mesh"), "errors are caught by their type");

  tetmend::Mesh mesh = part;
  expect(improve_watched(mesh) == tetmend::Ending::finished, "a run that nobody stops ends");
  stop_button = true;
  expect(improve_watched(mesh) == tetmend::Ending::cancelled, "the button stops a run");

  expect(follow(part, 5, 0.5) > 0, "a session mends what a solver moves");

  mesh = part;
  const tetmend::Result result = improve_by_own_script(mesh, argv[1]);
  std::size_t rounds = 0;
  for (const std::string& note : result.notes) rounds += note.rfind("bad tets:", 0) == 0 ? 1 : 0;
  expect(rounds == 3, "the script ran its three rounds");
  std::size_t accepted = 0;
  for (const tetmend::Pass& pass : result.passes) accepted += pass.accepted();
  std::printf("odt_smoothing: %zu accepted\n", accepted);
  expect(accepted > 0, "the operator of the plugin did something");
  expect(tetmend::operators({argv[1]}).back().name == "odt_smoothing", "operators are listed");
  return 0;
}
