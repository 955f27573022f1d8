// SPDX-License-Identifier: MIT
#include "viewer/mesh/visibility.h"

#include <algorithm>

namespace tetmend::viewer {

std::vector<Plane> planes_of(const SceneSettings& settings, const Ball& ball, bool exact) {
  std::vector<Plane> planes;
  for (const CutPlane& cut : settings.cuts) {
    if (!cut.on || cut.exact != exact) continue;
    const glm::dvec3 normal = glm::normalize(cut.normal);
    planes.push_back({normal, glm::dot(normal, ball.centre) + cut.position * ball.radius});
  }
  return planes;
}

glm::dvec3 to_glm(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

std::vector<std::uint8_t> chosen_tets(const TetMesh& mesh, const SceneSettings& settings,
                                      const TetFigures& figures) {
  std::vector<std::uint8_t> chosen(mesh.tet_slots());
  const auto& hidden = settings.hidden_regions;
  for (std::uint32_t i = 0; i < chosen.size(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    const bool in_range = settings.range.contains(static_cast<double>(figures.values[i]));
    if (settings.filtered && in_range == settings.outside) continue;
    if (!hidden.empty() && std::find(hidden.begin(), hidden.end(), mesh.label(t)) != hidden.end()) {
      continue;
    }
    chosen[i] = 1;
  }
  return chosen;
}

void hide_cut_and_peeled(const TetMesh& mesh, const SceneSettings& settings,
                         const TetFigures& figures, const Ball& ball,
                         std::vector<std::uint8_t>& shown) {
  const auto peel = static_cast<std::uint32_t>(settings.peel);
  const std::vector<Plane> planes = planes_of(settings, ball, false);
  if (peel == 0 && planes.empty()) return;
  for (std::uint32_t i = 0; i < shown.size(); ++i) {
    if (shown[i] == 0) continue;
    if (peel > 0 && figures.layers[i] < peel) shown[i] = 0;
    if (planes.empty()) continue;
    const TetVertices& v = mesh.vertices(TetHandle(i));
    const Point sum = mesh.point(v[0]) + mesh.point(v[1]) + mesh.point(v[2]) + mesh.point(v[3]);
    const glm::dvec3 centre = to_glm(sum) / 4.0;
    for (const Plane& plane : planes) {
      if (plane.height(centre) > 0) shown[i] = 0;
    }
  }
}

}  // namespace tetmend::viewer
