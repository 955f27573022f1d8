// SPDX-License-Identifier: MIT
// The only file of the kernel that includes CGAL: its headers are slow to compile.
#include "kernel/exact_orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace tetmend {

int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto convert = [](const Point& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  return static_cast<int>(CGAL::orientation(convert(a), convert(b), convert(c), convert(d)));
}

ExactOrientation count_orientations(const TetMesh& mesh) {
  ExactOrientation count;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    const TetVertices& v = mesh.vertices(t);
    const int sign =
        exact_orientation(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
    ++(sign > 0 ? count.positive : sign < 0 ? count.negative : count.zero);
  }
  return count;
}

}  // namespace tetmend
