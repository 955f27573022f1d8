// SPDX-License-Identifier: MIT
// The only file of the kernel that includes CGAL: its headers are slow to compile.
#include "kernel/exact_orientation.h"

#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "kernel/chunks.h"

namespace tetmend {

int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto convert = [](const Point& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  return static_cast<int>(CGAL::orientation(convert(a), convert(b), convert(c), convert(d)));
}

bool is_turned_over(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double v6 = volume6(a, b, c, d);
  return std::isnormal(v6) ? v6 < 0 : exact_orientation(a, b, c, d) < 0;
}

ExactOrientation count_orientations(const TetMesh& mesh) {
  const auto parts =
      map_chunks<ExactOrientation>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        ExactOrientation count;
        for (std::size_t slot = begin; slot < end; ++slot) {
          const TetHandle t(static_cast<std::uint32_t>(slot));
          if (mesh.is_deleted(t)) continue;
          const TetVertices& v = mesh.vertices(t);
          const int sign = mesh.is_certified_positive(v)
                               ? 1
                               : exact_orientation(mesh.point(v[0]), mesh.point(v[1]),
                                                   mesh.point(v[2]), mesh.point(v[3]));
          ++(sign > 0 ? count.positive : sign < 0 ? count.negative : count.zero);
        }
        return count;
      });
  ExactOrientation sum;
  for (const ExactOrientation& part : parts) {
    sum.positive += part.positive;
    sum.zero += part.zero;
    sum.negative += part.negative;
  }
  return sum;
}

}  // namespace tetmend
