// SPDX-License-Identifier: MIT
#include "kernel/thin_stars.h"

#include "kernel/chunks.h"

namespace tetmend {

ThinStars::ThinStars(const TetMesh& mesh, double step2)
    : size_(mesh.vertex_slots()), marks_(new std::atomic<std::uint8_t>[size_]()) {
  for_chunks(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TetHandle t(static_cast<std::uint32_t>(i));
      if (mesh.is_deleted(t)) continue;
      const TetVertices& v = mesh.vertices(t);
      const P1Diagonal of =
          p1_diagonal(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
      for (std::size_t corner = 0; corner < 4; ++corner) {
        if (is_thin(of, corner, step2)) add(v[corner]);
      }
    }
  });
}

}  // namespace tetmend
