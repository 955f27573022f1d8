// SPDX-License-Identifier: MIT
//   library_user IN OUT PLUGIN
// Improves a mesh and then tries the first operator of a plugin at every vertex.
#include <exception>
#include <iostream>
#include <memory>

#include "kernel/formats/mesh_io.h"
#include "kernel/mesh_view.h"
#include "ops/plugin.h"
#include "schedule/schedule.h"

int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  tetmend::TetMesh mesh = tetmend::TetMesh::sorted(tetmend::read_mesh(argv[1]));
  tetmend::Registry registry = tetmend::Registry::builtin();
  const tetmend::Plugin plugin = tetmend::load_plugin(argv[3], registry);
  tetmend::Run run(mesh, registry);
  tetmend::improve(run);
  const auto op = registry.make(plugin.operators.at(0)->name);
  std::size_t accepted = 0;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const tetmend::VertexHandle v(i);
    if (mesh.is_deleted(v)) continue;
    const auto verdict = run.worker().attempt(*op, tetmend::Target::of(v));
    if (verdict == tetmend::Verdict::accepted) ++accepted;
  }
  tetmend::write_mesh(argv[2], tetmend::MeshView(mesh));
  std::cout << plugin.operators[0]->name << ": " << accepted << " accepted\n";
  return accepted > 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
