// SPDX-License-Identifier: MIT
#include "viewer/live/carried_data.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "face/carry.h"
#include "face/maps.h"
#include "face/mid_nodes.h"

namespace tetmend::viewer {

bool holds_more_than_mesh(const MeshData& data) {
  return face::holds_more(data);
}

MeshData carried_data(const MeshData& before, const TetMesh& mesh) {
  std::vector<std::uint32_t> slots(before.tets.size());  // those of the tets as the file has them
  std::iota(slots.begin(), slots.end(), 0U);
  slots.resize(std::max<std::size_t>(slots.size(), mesh.tet_slots()), 0);
  std::vector<std::uint32_t> vertices = face::map_vertices(mesh, before.points.size());
  std::vector<std::uint32_t> tets = face::map_tets(mesh, slots);
  tets.resize(before.tets.size());
  MeshData now = TetMesh(mesh).to_data();
  face::renew_mid_nodes(before, vertices, now);
  face::carry(before, vertices, tets, {}, now);
  return now;
}

}  // namespace tetmend::viewer
