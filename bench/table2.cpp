// SPDX-License-Identifier: MIT
// One local-reconnection pass over the bad tets with each scheme, as in [chen, Table 2]. Prints
// JSON: one row for each scheme, in order.
//
//   table2 MESH
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "kernel/formats/mesh_io.h"
#include "schedule/passes.h"

namespace {

using namespace tetmend;
using Json = nlohmann::ordered_json;

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

Json row(const char* name, const MeshStatistics& s, double seconds) {
  return {{"scheme", name},           {"tets", s.tets},     {"theta_min", s.theta_min},
          {"theta_max", s.theta_max}, {"lambda", s.lambda}, {"lambda_bands", s.lambda_bands},
          {"n_bad", s.n_bad},         {"seconds", seconds}};
}

Json run(const std::filesystem::path& file, const Registry& registry) {
  const MeshData data = read_mesh(file);
  Json rows = {row("input", compute_statistics(TetMesh(data)), 0)};
  for (const Scheme& scheme : schemes()) {
    TetMesh mesh(data);
    mesh.sort_spatially();
    Run run(mesh, registry);
    local_reconnection(run, scheme.pass);
    rows.push_back(row(scheme.name, compute_statistics(mesh), run.records.back().seconds));
  }
  return rows;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: table2 MESH\n");
    return 2;
  }
  try {
    Registry registry;
    register_builtin_operators(registry);
    std::cout << run(arguments[1], registry).dump(2) << '\n';
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "table2: {}\n", error.what());
    return 1;
  }
}
