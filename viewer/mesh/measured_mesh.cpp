// SPDX-License-Identifier: MIT
#include "viewer/mesh/measured_mesh.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "envelope/unjoined.h"
#include "viewer/mesh/tet_values.h"
#include "viewer/mesh/visibility.h"

namespace tetmend::viewer {

namespace {

template <class Visit>
void for_each_used_point(const TetMesh& mesh, Visit visit) {
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (!mesh.is_deleted(v) && mesh.tet_of(v).is_valid()) visit(to_glm(mesh.point(v)));
  }
}

std::array<glm::dvec3, 8> box_corners(const TetMesh& mesh) {
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high = -low;
  for_each_used_point(mesh, [&](const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  });
  std::array<glm::dvec3, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i) {
    corners[i] = {(i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                  (i & 4U) != 0 ? high.z : low.z};
  }
  return corners;
}

Ball enclosing_ball(const TetMesh& mesh, const glm::dvec3& centre) {
  double radius = 1e-12;
  for_each_used_point(
      mesh, [&](const glm::dvec3& p) { radius = std::max(radius, glm::distance(p, centre)); });
  return {centre, radius};
}

}  // namespace

MeasuredMesh::MeasuredMesh(TetMesh measured)
    : mesh(std::move(measured)),
      box(box_corners(mesh)),
      ball(enclosing_ball(mesh, box.front() / 2.0 + box.back() / 2.0)),
      statistics(compute_statistics(mesh, mesh.standard().goal())),
      regions(region_labels(mesh)) {}

std::vector<std::string> notes_of_parts(const TetMesh& mesh) {
  return describe(find_unjoined(mesh), mesh.vertex_count());
}

}  // namespace tetmend::viewer
