// SPDX-License-Identifier: MIT
#include "envelope/kept_points.h"

#include <cstddef>
#include <cstdint>

namespace tetmend {

std::vector<char> find_kept_points(const MeshData& input) {
  std::vector<char> kept(input.points.size(), 0);
  for (const PeriodicLink& link : input.periodic) {
    for (const auto& [image, original] : link.points) kept[image] = kept[original] = 1;
  }
  for (const OtherElements& others : input.other_elements) {
    for (const std::uint32_t v : others.vertices) kept[v] = 1;
  }
  for (const Group& group : input.groups) {
    for (const std::uint32_t i : group.members) {
      if (group.dimension == 0 && group.name == "Corners") {
        kept[i] = 1;
      } else if (group.dimension == 1 && group.name == "RequiredEdges") {
        for (const std::uint32_t v : input.edges[i].vertices) kept[v] = 1;
      } else if (group.dimension == 2 && group.name == "RequiredTriangles") {
        for (const std::uint32_t v : input.triangles[i].vertices) kept[v] = 1;
      }
    }
  }
  return kept;
}

std::vector<VertexHandle> kept_vertices(const TetMesh& mesh, std::span<const char> kept_points) {
  std::vector<VertexHandle> kept;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (mesh.is_deleted(v) || mesh.origin(v) == TetMesh::kNotFromFile) continue;
    if (kept_points[mesh.origin(v)] != 0) kept.push_back(v);
  }
  return kept;
}

}  // namespace tetmend
