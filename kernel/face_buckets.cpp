// SPDX-License-Identifier: MIT
// The faces of all tets, found by their smallest vertex.
#include "kernel/face_buckets.h"

#include <algorithm>

#include "kernel/chunks.h"

namespace tetmend {

FaceBuckets::FaceBuckets(const TetMesh& mesh, Grouping by_smallest)
    : mesh_(mesh), by_smallest_(std::move(by_smallest)) {
  std::vector<std::uint32_t> second(mesh.tet_slots());
  for_chunks(second.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TetVertices& v = mesh.vertices(TetHandle(static_cast<std::uint32_t>(i)));
      const VertexHandle low = std::min(v[0], v[1]);
      const VertexHandle other_low = std::min(v[2], v[3]);
      // The greater of the two, unless a partner of the smaller comes before it.
      const VertexHandle partner = low < other_low ? std::max(v[0], v[1]) : std::max(v[2], v[3]);
      second[i] = std::min(std::max(low, other_low), partner).index();
    }
  });
  by_second_ = group_by_key(second, static_cast<std::uint32_t>(mesh.vertex_slots()));
}

HalfFace FaceBuckets::find(std::array<std::uint32_t, 3> vertices) const {
  std::sort(vertices.begin(), vertices.end());
  const std::uint32_t v = vertices[0];
  const auto side_in = [&](TetHandle t) {
    std::array<bool, 4> in_face{};
    for (const std::uint32_t w : vertices) {
      const unsigned local = mesh_.local_index(t, VertexHandle(w));
      if (local == 4) return HalfFace();
      in_face[local] = true;
    }
    unsigned f = 0;
    while (in_face[f]) ++f;
    return HalfFace(t, f);
  };
  for (std::uint32_t i = by_smallest_.begin[v]; i < by_smallest_.begin[v + 1]; ++i) {
    if (const HalfFace f = side_in(tet_at(i)); f != HalfFace()) return f;
  }
  for (const std::uint32_t i : by_second_.group(v)) {
    if (const HalfFace f = side_in(TetHandle(i)); f != HalfFace()) return f;
  }
  return {};
}

}  // namespace tetmend
