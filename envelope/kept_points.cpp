// SPDX-License-Identifier: MIT
#include "envelope/kept_points.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace tetmend {

std::vector<char> find_kept_points(const MeshData& input) {
  std::vector<char> kept(input.points.size(), 0);
  for (const PeriodicLink& link : input.periodic) {
    for (const auto& [image, original] : link.points) kept[image] = kept[original] = kHeldPoint;
  }
  for (const OtherElements& others : input.other_elements) {
    for (const std::uint32_t v : others.vertices) kept[v] = kHeldPoint;
  }
  for (const Group& group : input.groups) {
    for (const std::uint32_t i : group.members) {
      if (group.dimension == 0 && group.name == "Corners") {
        kept[i] = std::max(kept[i], kKeptPoint);
      } else if (group.dimension == 1 && group.name == "RequiredEdges") {
        for (const std::uint32_t v : input.edges[i].vertices) kept[v] = kHeldPoint;
      } else if (group.dimension == 2 && group.name == "RequiredTriangles") {
        for (const std::uint32_t v : input.triangles[i].vertices) kept[v] = kHeldPoint;
      }
    }
  }
  return kept;
}

namespace {

std::vector<VertexHandle> vertices_of(const TetMesh& mesh, std::span<const char> kept_points,
                                      char least) {
  std::vector<VertexHandle> vertices;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (mesh.is_deleted(v) || mesh.origin(v) == TetMesh::kNotFromFile) continue;
    if (kept_points[mesh.origin(v)] >= least) vertices.push_back(v);
  }
  return vertices;
}

}  // namespace

std::vector<VertexHandle> kept_vertices(const TetMesh& mesh, std::span<const char> kept_points) {
  return vertices_of(mesh, kept_points, kKeptPoint);
}

std::vector<VertexHandle> held_vertices(const TetMesh& mesh, std::span<const char> kept_points) {
  return vertices_of(mesh, kept_points, kHeldPoint);
}

}  // namespace tetmend
