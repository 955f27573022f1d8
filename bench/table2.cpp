// SPDX-License-Identifier: MIT
// One local-reconnection pass over the bad tets with each scheme, as in [chen, Table 2].
//
//   table2 MESH...
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>

#include <fmt/core.h>

#include "kernel/formats/mesh_io.h"
#include "schedule/passes.h"

namespace {

using namespace tetmend;

struct Scheme {
  const char* name;
  LocalReconnection pass;
};

std::array<Scheme, 4> schemes() {
  LocalReconnection grummp{
      .edge_operator = "edge_removal", .face_operator = "flip_2_3", .sweeps = 1};
  LocalReconnection stellar{.edge_operator = "edge_removal", .sweeps = 1};
  LocalReconnection flat{.edge_settings = {{"max_level", 0}}, .sweeps = 1};
  LocalReconnection recursive{.edge_settings = {{"max_level", 5}}, .sweeps = 1};
  return {{{"2-3 flip + edge removal", grummp},
           {"edge removal + multi-face", stellar},
           {"shell transformation, l_max 0", flat},
           {"shell transformation, l_max 5", recursive}}};
}

void print_row(const char* name, const MeshStatistics& s, double seconds) {
  fmt::print("{:30} {:>9} {:>8.4f} {:>8.3f} {:>8.4f}", name, s.tets, s.theta_min, s.theta_max,
             s.lambda);
  for (const double band : s.lambda_bands) fmt::print(" {:>7.4f}", band);
  fmt::print(" {:>7} {:>7.3f}\n", s.n_bad, seconds);
}

void run(const std::filesystem::path& file, const Registry& registry) {
  const MeshData data = read_mesh(file);
  fmt::print("{}\n{:30} {:>9} {:>8} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7}\n",
             file.filename().string(), "one pass", "tets", "th_min", "th_max", "lambda%", "l1%",
             "l2%", "l3%", "l4%", "l5%", "bad", "seconds");
  print_row("input", compute_statistics(TetMesh(data)), 0);
  for (const Scheme& scheme : schemes()) {
    TetMesh mesh(data);
    mesh.sort_spatially();
    Run run(mesh, registry);
    local_reconnection(run, scheme.pass);
    print_row(scheme.name, compute_statistics(mesh), run.records.back().seconds);
  }
  fmt::print("\n");
}

}  // namespace

int main(int count, char** arguments) {
  try {
    Registry registry;
    register_builtin_operators(registry);
    for (int i = 1; i < count; ++i) run(arguments[i], registry);
    return count > 1 ? 0 : 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "table2: {}\n", error.what());
    return 1;
  }
}
