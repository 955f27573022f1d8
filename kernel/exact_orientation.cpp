// SPDX-License-Identifier: MIT
#include "kernel/exact_orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace tetmend {

OrientationCounts count_orientations(const TetMesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto to_cgal = [&](VertexHandle v) {
    const Point& p = mesh.point(v);
    return Kernel::Point_3(p.x(), p.y(), p.z());
  };
  OrientationCounts counts;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    const TetVertices& v = mesh.vertices(t);
    switch (CGAL::orientation(to_cgal(v[0]), to_cgal(v[1]), to_cgal(v[2]), to_cgal(v[3]))) {
      case CGAL::POSITIVE: ++counts.positive; break;
      case CGAL::COPLANAR: ++counts.flat; break;
      case CGAL::NEGATIVE: ++counts.inverted; break;
    }
  }
  return counts;
}

}  // namespace tetmend
