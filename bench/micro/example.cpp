// SPDX-License-Identifier: MIT
#include "bench/micro/example.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "kernel/formats/mesh_io.h"
#include "kernel/shell.h"

namespace tetmend::bench {

namespace {

TetMesh sorted(const MeshData& data) {
  TetMesh mesh(data);
  mesh.sort_spatially();
  return mesh;
}

}  // namespace

const MeshData& example_data() {
  static const MeshData kData = read_mesh(TETMEND_SOURCE_DIR "/assets/meshes/bracket.meshb");
  return kData;
}

const TetMesh& example_mesh() {
  static const TetMesh kMesh = sorted(example_data());
  return kMesh;
}

std::vector<TetEdge> edges_of_degree(const TetMesh& mesh, unsigned degree) {
  std::vector<TetEdge> edges;
  Shell shell;
  for (std::uint32_t t = 0; t < mesh.tet_slots(); ++t) {
    for (unsigned e = 0; e < 6; ++e) {
      const TetEdge edge(TetHandle(t), e);
      if (find_shell(mesh, edge, shell, Territory()) != ShellKind::closed || shell.degree != degree)
        continue;
      // The first tet of a shell lists its edge.
      if (*std::min_element(shell.tets.begin(), shell.tets.begin() + degree) == edge.tet())
        edges.push_back(edge);
    }
  }
  return edges;
}

std::vector<VertexHandle> bad_vertices(const TetMesh& mesh) {
  std::vector<bool> bad(mesh.vertex_slots());
  for (std::uint32_t t = 0; t < mesh.tet_slots(); ++t) {
    if (mesh.quality(TetHandle(t)) >= kBadThreshold) continue;
    for (const VertexHandle v : mesh.vertices(TetHandle(t))) bad[v.index()] = !mesh.is_fixed(v);
  }
  std::vector<VertexHandle> vertices;
  for (std::uint32_t v = 0; v < bad.size(); ++v) {
    if (bad[v]) vertices.emplace_back(v);
  }
  return vertices;
}

}  // namespace tetmend::bench
