// SPDX-License-Identifier: MIT
// Where the vertices and tets of a mesh went.
#include "face/maps.h"

#include <tetmend/improve.h>

#include "kernel/mesh_view.h"

namespace tetmend::face {

std::vector<std::uint32_t> map_vertices(const TetMesh& mesh, std::size_t count) {
  std::vector<std::uint32_t> map(count, kGone);
  const MeshView view(mesh);
  const std::span<const std::uint32_t> slots = view.vertex_slots();
  for (std::uint32_t i = 0; i < slots.size(); ++i) {
    const std::uint32_t old = mesh.origin(VertexHandle(slots[i]));
    if (old != TetMesh::kNotFromFile) map[old] = i;
  }
  return map;
}

std::vector<std::uint32_t> map_tets(const TetMesh& mesh, std::span<const std::uint32_t> numbers) {
  std::vector<std::uint32_t> map(numbers.size(), kGone);
  std::uint32_t next = 0;
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh.is_deleted(t)) continue;
    if (!mesh.is_created(t)) map[numbers[slot]] = next;
    ++next;
  }
  return map;
}

}  // namespace tetmend::face
