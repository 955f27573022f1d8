// SPDX-License-Identifier: MIT
#include "kernel/tet_faces.h"

#include <algorithm>
#include <utility>

namespace tetmend {

std::vector<TetFace> sorted_tet_faces(const MeshData& mesh) {
  std::vector<TetFace> faces;
  faces.reserve(4 * mesh.tets.size());
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& v = mesh.tets[t].vertices;
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      TetFace face{{}, t};
      for (std::size_t k = 0; k < 3; ++k) face.vertices[k] = v[k < left_out ? k : k + 1];
      std::sort(face.vertices.begin(), face.vertices.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end(), [](const TetFace& a, const TetFace& b) {
    return std::pair(a.vertices, a.tet) < std::pair(b.vertices, b.tet);
  });
  return faces;
}

}  // namespace tetmend
