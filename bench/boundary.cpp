// SPDX-License-Identifier: MIT
#include "bench/boundary.h"

#include <algorithm>
#include <cstddef>

namespace tetmend::bench {

namespace {

struct KeyedFace {
  Face key;
  Face face;
};

}  // namespace

Face face_key(Face face) {
  std::ranges::sort(face);
  return face;
}

std::vector<Face> boundary_faces(const MeshData& mesh) {
  std::vector<KeyedFace> faces;
  faces.reserve(4 * mesh.tets.size());
  for (const MeshData::Tet& tet : mesh.tets) {
    const auto& [a, b, c, d] = tet.vertices;
    for (const Face& face : {Face{b, c, d}, Face{a, d, c}, Face{a, b, d}, Face{a, c, b}}) {
      faces.push_back({face_key(face), face});
    }
  }
  std::ranges::sort(faces, {}, &KeyedFace::key);

  std::vector<Face> boundary;
  for (std::size_t first = 0; first < faces.size();) {
    std::size_t last = first + 1;
    while (last < faces.size() && faces[last].key == faces[first].key) ++last;
    if (last - first == 1) boundary.push_back(faces[first].face);
    first = last;
  }
  return boundary;
}

}  // namespace tetmend::bench
