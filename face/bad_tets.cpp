// SPDX-License-Identifier: MIT
#include "face/bad_tets.h"

#include <algorithm>

#include "kernel/quality.h"

namespace tetmend {

BadTet face::describe(const TetMesh& mesh, TetHandle t, Hindrance hindrance) {
  const TetVertices& v = mesh.vertices(t);
  BadTet tet{.label = mesh.label(t), .hindrance = hindrance};
  Point centre = Point::Zero();
  for (const VertexHandle w : v) {
    centre += mesh.point_in_file(w) / 4;
    tet.free_vertices += !mesh.is_fixed(w);
  }
  tet.centre = {centre.x(), centre.y(), centre.z()};
  const auto angles =
      dihedral_angles(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
  const auto [least, greatest] = std::minmax_element(angles.begin(), angles.end());
  tet.theta_min = *least;
  tet.theta_max = *greatest;
  tet.quality =
      minimum_sine(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
  return tet;
}

}  // namespace tetmend
