// SPDX-License-Identifier: MIT
#include "schedule/limit/inverted_tets.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "kernel/star.h"
#include "kernel/workspace.h"
#include "search/star_kernel.h"

namespace tetmend {

namespace {

bool sees_its_link(const TetMesh& mesh, VertexHandle v, Workspace& workspace) {
  std::vector<std::array<Point, 3>> faces;
  for (const HalfFace f : link(mesh, v, workspace)) {
    // Counterclockwise from outside: turned, so that the vertex is on the positive side.
    const auto corners = mesh.vertices(f);
    faces.push_back({mesh.point(corners[0]), mesh.point(corners[2]), mesh.point(corners[1])});
  }
  return has_kernel(faces);
}

}  // namespace

InvertedTets count_inverted(const TetMesh& mesh) {
  constexpr Quality kLeastAboveZero = std::numeric_limits<Quality>::denorm_min();
  std::vector<TetHandle> found;
  mesh.visit_below(kLeastAboveZero, 0, mesh.tet_slots(), [&](TetHandle t) { found.push_back(t); });
  InvertedTets count;
  if (found.empty()) return count;
  Workspace workspace(mesh);
  for (const TetHandle t : found) {
    const TetVertices& corners = mesh.vertices(t);
    const auto is_free = [&](VertexHandle v) { return !mesh.is_fixed(v); };
    const auto has_place = [&](VertexHandle v) {
      return is_free(v) && sees_its_link(mesh, v, workspace);
    };
    std::size_t& kind = mesh.is_frozen(t)                                        ? count.frozen
                        : std::none_of(corners.begin(), corners.end(), is_free)  ? count.fixed
                        : std::any_of(corners.begin(), corners.end(), has_place) ? count.open
                                                                                 : count.sealed;
    ++kind;
  }
  return count;
}

}  // namespace tetmend
